// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/routing/router.h"

namespace external_command {

/// Driven distance from `start` to `goal`, the simplest way there is: Dijkstra over whole lanes, where a lane can be
/// left for its neighbour only where it is entered, at no cost and in no room. Independent of Router.
/// @return infinity where there is no route.
double referenceDistance(const HdMap& map, const LanePoint& start, const LanePoint& goal);

/// The same, but lanes of which any part is in `black_list` do not exist.
double referenceDistance(const HdMap& map, const LanePoint& start, const LanePoint& goal,
                         const std::vector<LaneRange>& black_list);

}  // namespace external_command
