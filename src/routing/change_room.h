// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/map/hd_map.h"
#include "lane_pair.h"

namespace external_command {

/// From `s` on, a change to the neighbour lane takes at least `length` along the lanes.
struct ChangeNeed {
  float s = 0.0F;       ///< on the lane that is left [m]
  float length = 0.0F;  ///< [m]
};

/// Sideways by `offset` on two opposite arcs of `radius` [m]: the shortest way along the road, by plane geometry [m].
double twoArcLength(double offset, double radius);

/// How much road changes from `a` to the lane beside it take, piece by piece along `a`: two opposite arcs over the
/// lateral distance of the centre lines there. The arcs take no more than four fifths of the curvature of which the
/// vehicle is capable, less that of the lanes: the rest is left for driving into and out of the arcs. Where the lanes
/// bend so much that nothing is left, the length is one that hardly any bend has.
/// @return by rising `s`, the first at the beginning of the pair.
std::vector<ChangeNeed> changeNeeds(const HdMap& map, LaneIndex a, const LanePair& pair, double min_turning_radius);

}  // namespace external_command
