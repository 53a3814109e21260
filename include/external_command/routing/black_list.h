// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/routing/router.h"

namespace external_command {

/// A lane, or a part of it, by id. `start_s == end_s == 0` means the whole lane.
struct BlackListedLane {
  std::string id;
  double start_s = 0.0;  ///< [m]
  double end_s = 0.0;    ///< [m]
};

/// The parts of lanes that lists of lanes and of roads name; ends are clamped to the lanes.
/// @throws InvalidRequest  an unknown lane or road, or a part that begins after its end or outside its lane; the text
///                         names the element, `blacklisted_lane[2]`.
std::vector<LaneRange> blackList(const HdMap& map, const std::vector<BlackListedLane>& lanes,
                                 const std::vector<std::string>& roads);

}  // namespace external_command
