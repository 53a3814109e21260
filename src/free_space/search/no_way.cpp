// SPDX-License-Identifier: Apache-2.0
#include "no_way.h"

#include "narrow_passage.h"

namespace external_command {

std::optional<NoWay> proveNoWay(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                const Pose2d& to, const WayMaps& ways, const std::function<bool()>& stop) {
  if (isTooNarrow(index, area, from, to, stop)) return NoWay{};
  if (auto turn = tightTurn(index, area, from, to, ways, stop)) return NoWay{turn};
  return std::nullopt;
}

}  // namespace external_command
