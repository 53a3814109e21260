// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "tight_turn.h"

namespace external_command {

/// A proof that the vehicle cannot get from one pose to another.
struct NoWay {
  std::optional<TightTurn> turn;  ///< nullopt where every way is closed, or too narrow for any heading
};

/// By isTooNarrow(), then by tightTurn(); nullopt proves nothing.
std::optional<NoWay> proveNoWay(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                const Pose2d& to, const WayMaps& ways, const std::function<bool()>& stop);

}  // namespace external_command
