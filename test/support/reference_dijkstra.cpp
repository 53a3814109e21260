// SPDX-License-Identifier: Apache-2.0
#include "support/reference_dijkstra.h"

#include <limits>
#include <queue>
#include <set>
#include <tuple>

namespace external_command {

namespace {

using State = std::tuple<double, LaneIndex, double>;  // driven so far, lane, s

}  // namespace

double referenceDistance(const HdMap& map, const LanePoint& start, const LanePoint& goal) {
  return referenceDistance(map, start, goal, {});
}

double referenceDistance(const HdMap& map, const LanePoint& start, const LanePoint& goal,
                         const std::vector<LaneRange>& black_list) {
  std::set<LaneIndex> closed;
  for (const LaneRange& range : black_list) closed.insert(range.lane);
  std::set<std::pair<LaneIndex, long>> seen;
  std::priority_queue<State, std::vector<State>, std::greater<>> queue;
  const auto push = [&](double distance, LaneIndex lane, double s) {
    if (map.lane(lane).isDrivable() && closed.count(lane) == 0) queue.emplace(distance, lane, s);
  };
  double best = std::numeric_limits<double>::infinity();
  push(0.0, start.lane, start.s);
  while (!queue.empty() && std::get<0>(queue.top()) < best) {
    const auto [distance, index, s] = queue.top();
    queue.pop();
    if (!seen.emplace(index, std::lround(s * 1e4)).second) continue;
    const Lane& lane = map.lane(index);
    if (index == goal.lane && s <= goal.s) best = std::min(best, distance + goal.s - s);
    for (const LaneIndex next : lane.successors) push(distance + lane.length() - s, next, 0.0);
    for (const auto* sides : {&lane.left_forward, &lane.right_forward}) {
      for (const LaneIndex other : *sides) push(distance, other, s / lane.length() * map.lane(other).length());
    }
  }
  return best;
}

}  // namespace external_command
