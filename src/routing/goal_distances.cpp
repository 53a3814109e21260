// SPDX-License-Identifier: Apache-2.0
#include "goal_distances.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr std::int32_t kUnreachable = RelaxedGraph::kUnreachable;
constexpr std::uint32_t kNone = ContractionHierarchy::kNoParent;
constexpr double kMaxPrice = 10000.0;  // so that sums stay in range; a bound may always be lower [m]

}  // namespace

struct GoalDistances::Workspace {
  struct Node {
    std::uint64_t leg = 0;
    std::int32_t distance = kUnreachable;  // so far: over nodes below alone
    bool is_final = false;
  };

  Node& nodeOf(std::uint32_t rank) {
    Node& node = nodes[rank];
    if (node.leg != leg) node = {leg, kUnreachable, false};
    return node;
  }

  std::vector<Node> nodes;
  std::vector<std::uint32_t> path;
  std::uint64_t leg = 0;
};

GoalDistances::GoalDistances(const LaneGraph& graph, const RouteIndex& index)
    : graph_(graph), index_(index), work_([]() -> Workspace& {
        thread_local Workspace workspace;
        return workspace;
      }()) {
  if (work_.nodes.size() < graph.size()) work_.nodes.resize(graph.size());
}

/// From `s` to the end of the lane [m].
double GoalDistances::countedRest(LaneIndex lane, double s) const {
  return index_.rates[lane] * (graph_.length(lane) - s);
}

void GoalDistances::setTargets(const std::vector<LanePoint>& targets) {
  ++work_.leg;
  for (const LanePoint& target : targets) climb(target);
}

/// A target lies before the end of its lane: from there it is a negative way.
void GoalDistances::climb(const LanePoint& target) {
  const double metres = std::min(target.price, kMaxPrice) - countedRest(target.lane, target.s);
  std::uint32_t rank = index_.hierarchy.rank(target.lane);
  std::int32_t& distance = work_.nodeOf(rank).distance;
  distance = std::min(distance, static_cast<std::int32_t>(std::floor(metres * RelaxedGraph::kUnitsPerMetre)));
  for (; rank != kNone; rank = index_.hierarchy.parent(rank)) {
    const std::int32_t so_far = work_.nodeOf(rank).distance;
    if (so_far == kUnreachable) continue;
    for (const ContractionHierarchy::Arc& arc : index_.hierarchy.arcsDown(rank)) {
      std::int32_t& above = work_.nodeOf(arc.upper).distance;
      above = std::min(above, so_far + arc.weight);
    }
  }
}

std::int32_t GoalDistances::fromEnd(std::uint32_t rank) {
  std::vector<std::uint32_t>& path = work_.path;
  for (path.clear(); rank != kNone && !work_.nodeOf(rank).is_final; rank = index_.hierarchy.parent(rank)) {
    path.push_back(rank);
  }
  std::int32_t distance = rank == kNone ? kUnreachable : work_.nodes[rank].distance;
  for (auto node = path.rbegin(); node != path.rend(); ++node) {
    distance = work_.nodes[*node].distance;
    for (const ContractionHierarchy::Arc& arc : index_.hierarchy.arcsUp(*node)) {
      distance = std::min(distance, work_.nodes[arc.upper].distance + arc.weight);
    }
    work_.nodes[*node].distance = distance;
    work_.nodes[*node].is_final = true;
  }
  return distance;
}

double GoalDistances::from(LaneIndex lane, double s) {
  const std::int32_t units = fromEnd(index_.hierarchy.rank(lane));
  return countedRest(lane, s) + units / RelaxedGraph::kUnitsPerMetre;
}

}  // namespace external_command
