// SPDX-License-Identifier: Apache-2.0
#include "goal_distances.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr std::int32_t kUnreachable = RelaxedGraph::kUnreachable;

}  // namespace

/// By rank. Distances lie close together, as those of many nodes are looked up for each node.
struct GoalDistances::Workspace {
  bool isKnown(std::uint32_t rank) const { return leg_known[rank] == leg; }
  bool isFinal(std::uint32_t rank) const { return leg_final[rank] == leg; }

  std::vector<std::int32_t> distances;              // where not final, over nodes below alone
  std::vector<std::uint64_t> leg_known, leg_final;  // the last leg in which the distance was so
  std::vector<std::uint32_t> path;
  std::uint64_t leg = 0;
};

GoalDistances::GoalDistances(const LaneGraph& graph, const RouteIndex& index)
    : graph_(graph), index_(index), work_([]() -> Workspace& {
        thread_local Workspace workspace;
        return workspace;
      }()) {
  if (work_.distances.size() >= graph.size()) return;
  work_.distances.resize(graph.size());
  work_.leg_known.resize(graph.size());
  work_.leg_final.resize(graph.size());
}

/// From `s` to the end of the lane [m].
double GoalDistances::countedRest(LaneIndex lane, double s) const {
  return index_.rates[lane] * (graph_.length(lane) - s);
}

void GoalDistances::setTargets(const std::vector<LanePoint>& targets) {
  ++work_.leg;
  for (const LanePoint& target : targets) climb(target);
}

/// From here to the root, without the nodes from which `is_there` is true on.
template <class IsThere>
const std::vector<std::uint32_t>& GoalDistances::pathUp(std::uint32_t rank, const IsThere& is_there) {
  work_.path.clear();
  for (; rank != ContractionHierarchy::kNoParent && !is_there(rank); rank = index_.hierarchy.parent(rank)) {
    work_.path.push_back(rank);
  }
  return work_.path;
}

/// A target lies before the end of its lane: from there it is a negative way.
void GoalDistances::climb(const LanePoint& target) {
  const std::uint32_t first = index_.hierarchy.rank(target.lane);
  for (const std::uint32_t rank : pathUp(first, [this](std::uint32_t at) { return work_.isKnown(at); })) {
    work_.distances[rank] = kUnreachable;
    work_.leg_known[rank] = work_.leg;
  }
  const double metres = std::min(target.price, RelaxedGraph::kMaxWeight) - countedRest(target.lane, target.s);
  std::int32_t& distance = work_.distances[first];
  distance = std::min(distance, static_cast<std::int32_t>(std::floor(metres * RelaxedGraph::kUnitsPerMetre)));
  for (const std::uint32_t rank : pathUp(first, [](std::uint32_t) { return false; })) {
    const std::int32_t so_far = work_.distances[rank];
    if (so_far == kUnreachable) continue;
    for (const ContractionHierarchy::Arc& arc : index_.hierarchy.arcsDown(rank)) {
      std::int32_t& above = work_.distances[arc.upper];
      above = std::min(above, so_far + arc.weight);
    }
  }
}

std::int32_t GoalDistances::fromEnd(std::uint32_t rank) {
  const auto& path = pathUp(rank, [this](std::uint32_t at) { return work_.isFinal(at); });
  for (auto node = path.rbegin(); node != path.rend(); ++node) {
    std::int32_t distance = work_.isKnown(*node) ? work_.distances[*node] : kUnreachable;
    for (const ContractionHierarchy::Arc& arc : index_.hierarchy.arcsUp(*node)) {
      distance = std::min(distance, work_.distances[arc.upper] + arc.weight);
    }
    work_.distances[*node] = distance;
    work_.leg_known[*node] = work_.leg_final[*node] = work_.leg;
  }
  return work_.distances[rank];
}

double GoalDistances::from(LaneIndex lane, double s) {
  const std::int32_t units = fromEnd(index_.hierarchy.rank(lane));
  return countedRest(lane, s) + units / RelaxedGraph::kUnitsPerMetre;
}

}  // namespace external_command
