// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/routing/router.h"

namespace external_command {

/// A lane, or a part of it, by id. `start_s == end_s == 0` means the whole lane.
struct BlackListedLane {
  std::string id;
  double start_s = 0.0;  ///< [m], on the lane
  double end_s = 0.0;    ///< [m], beyond start_s
};

/// The parts of lanes that lists of lanes and of roads name; an end beyond the lane's is the lane's.
/// @throws InvalidRequest  an unknown lane or road, or a part that begins outside its lane, or does not end after its
///                         beginning; the text names the element, `blacklisted_lane[2]`.
std::vector<LaneRange> blackList(const HdMap& map, const std::vector<BlackListedLane>& lanes,
                                 const std::vector<std::string>& roads);

}  // namespace external_command
