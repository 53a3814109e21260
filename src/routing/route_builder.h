// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "blocked_lanes.h"
#include "external_command/routing/router.h"
#include "lane_graph.h"
#include "search_label.h"

namespace external_command {

/// Makes the route of what a search has found. The search knows the least room for each lane change; here each gets as
/// much as the road leaves, and several in a row share it.
/// @param labels  from start to goal, not empty.
Route buildRoute(const LaneGraph& graph, const BlockedLanes& blocked, const std::vector<SearchLabel>& labels);

}  // namespace external_command
