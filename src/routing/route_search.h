// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "label_search.h"

namespace external_command {

/// The reached places of one query, from the start to the goal or to where it failed.
struct SearchResult {
  std::vector<SearchLabel> labels;  ///< from start to goal; empty where there is no route
  std::size_t failed_leg = 0;       ///< which leg could not be driven; 0 ends at the first way point
  std::size_t reached_lanes = 0;    ///< in the leg that failed
  std::size_t found_labels = 0;     ///< in all legs: what the search took
};

/// Shortest route through the way points in order, lane by lane.
/// @param index  speeds it up, and changes no cost; nullptr: there is none.
/// @throws Cancelled
SearchResult searchRoute(const LaneGraph& graph, const RouteIndex* index, const RouterParams& params, ChangeRule rule,
                         const RouteQuery& query, const BlockedLanes& blocked, const CancelToken& cancel);

}  // namespace external_command
