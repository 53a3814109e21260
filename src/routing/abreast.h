// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "blocked_lanes.h"
#include "lane_graph.h"

namespace external_command {

/// How far from `old_place`, abreast of `new_s` on its neighbour, both lanes stay free and the line between crossable.
/// @return `s` on the neighbour; `new_s` where not even this place is so.
double abreastUntil(const LaneGraph& graph, const BlockedLanes& blocked, const LanePoint& old_place,
                    const LaneGraph::Neighbour& neighbour, double new_s);

}  // namespace external_command
