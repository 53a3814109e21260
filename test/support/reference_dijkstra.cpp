// SPDX-License-Identifier: Apache-2.0
#include "support/reference_dijkstra.h"

#include <limits>
#include <map>
#include <queue>
#include <set>
#include <tuple>

namespace external_command {

namespace {

using State = std::tuple<double, LaneIndex, double>;  // cost so far, lane, s
using Ends = std::map<std::size_t, double>;           // cost at each candidate that can be reached

class Reference {
 public:
  Reference(const HdMap& map, const std::vector<LaneRange>& black_list, double change_price)
      : map_(map), change_price_(change_price) {
    for (const LaneRange& range : black_list) closed_.insert(range.lane);
  }

  /// All the way to every goal from the places where the leg before has ended.
  Ends drive(const std::vector<LanePoint>& starts, const Ends& costs, const std::vector<LanePoint>& goals) {
    queue_ = {};
    std::set<std::pair<LaneIndex, long>> seen;
    Ends ends;
    for (const auto& [i, cost] : costs) push(cost, starts[i].lane, starts[i].s);
    while (!queue_.empty()) {
      const auto [cost, index, s] = queue_.top();
      queue_.pop();
      if (!seen.emplace(index, std::lround(s * 1e4)).second) continue;
      for (std::size_t i = 0; i < goals.size(); ++i) {
        if (goals[i].lane != index || s > goals[i].s) continue;
        const auto end = ends.emplace(i, std::numeric_limits<double>::infinity()).first;
        end->second = std::min(end->second, cost + goals[i].s - s);
      }
      leave(cost, map_.lane(index), s);
    }
    return ends;
  }

 private:
  void leave(double cost, const Lane& lane, double s) {
    for (const LaneIndex next : lane.successors) push(cost + lane.length() - s, next, 0.0);
    for (const auto* sides : {&lane.left_forward, &lane.right_forward}) {
      for (const LaneIndex other : *sides) {
        push(cost + change_price_, other, s / lane.length() * map_.lane(other).length());
      }
    }
  }

  void push(double cost, LaneIndex lane, double s) {
    if (map_.lane(lane).isDrivable() && closed_.count(lane) == 0) queue_.emplace(cost, lane, s);
  }

  const HdMap& map_;
  const double change_price_;
  std::set<LaneIndex> closed_;
  std::priority_queue<State, std::vector<State>, std::greater<>> queue_;
};

}  // namespace

double referenceCost(const HdMap& map, const RouteQuery& query, double change_price) {
  Reference reference(map, query.black_list, change_price);
  Ends ends;
  for (std::size_t i = 0; i < query.starts.size(); ++i) ends[i] = 0.0;
  const std::vector<LanePoint>* from = &query.starts;
  for (std::size_t leg = 0; leg <= query.via.size(); ++leg) {
    const std::vector<LanePoint>& to = leg < query.via.size() ? query.via[leg] : query.goals;
    ends = reference.drive(*from, ends, to);
    from = &to;
  }
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [i, cost] : ends) best = std::min(best, cost);
  return best;
}

}  // namespace external_command
