// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "contraction_hierarchy.h"
#include "relaxed_graph.h"

namespace external_command {

/// What is made of the lanes once, so that each search knows how far the goal is at least (GoalDistances). Immutable.
struct RouteIndex {
  RouteIndex(const LaneGraph& graph, const RouterParams& params)
      : RouteIndex(RelaxedGraph(graph, params.lane_change_price)) {}

  /// Empty, for what was kept.
  RouteIndex() = default;

  /// Calls `visit(array)` for each array of which the index consists, by which it can be kept.
  template <class Visit>
  void forEachArray(const Visit& visit) const {
    hierarchy.forEachArray(visit);
    visit(rates);
  }
  template <class Visit>
  void forEachArray(const Visit& visit) {
    hierarchy.forEachArray(visit);
    visit(rates);
  }

  ContractionHierarchy hierarchy;
  std::vector<double> rates;  ///< as in RelaxedGraph

 private:
  explicit RouteIndex(RelaxedGraph relaxed) : hierarchy(relaxed), rates(std::move(relaxed.rates)) {}
};

}  // namespace external_command
