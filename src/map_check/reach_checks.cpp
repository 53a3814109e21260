// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/strong_components.hpp>
#include <vector>

#include "checks.h"
#include "routing/lane_graph.h"

namespace external_command {

namespace {

using Directed = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
using Undirected = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
using Parts = std::vector<int>;  // the part that each lane belongs to

constexpr double kMainShare = 0.5;  // of the length of all lanes, that can be driven round in
constexpr std::size_t kNamed = 20;  // lanes of a part

/// Which lanes lead onto which, by links and lane changes, as the router has it.
class Reach {
 public:
  explicit Reach(const MapUnderCheck& check)
      : check_(check), map_(check.map), ways_(map_.lanes().size()), joined_(map_.lanes().size()) {
    RouterParams params;
    params.min_turning_radius = check.vehicle.min_turning_radius;
    const LaneGraph graph(map_, params);
    for (LaneIndex lane = 0; lane < graph.size(); ++lane) {
      for (const LaneGraph::Link& next : graph.successors(lane)) join(lane, next.lane);
      for (const LaneGraph::Neighbour& other : graph.neighbours(lane)) join(lane, other.pair.b);
      // Who can stand on a lane of both directions may have come from either end.
      if (map_.lane(lane).reverse) boost::add_edge(lane, *map_.lane(lane).reverse, joined_);
    }
  }

  void run() {
    const Parts islands = partsOf(joined_);
    const int mainland = longest(islands);
    Parts rounds(map_.lanes().size());
    boost::strong_components(ways_, rounds.data());
    const int main = longest(rounds);
    const bool is_round = std::count(rounds.begin(), rounds.end(), main) > 1;
    if (!is_round || lengthOf(rounds, main) < kMainShare * lengthOf(islands, mainland)) {
      check_.notes->push_back(
          "most lanes lie on no way round, as in a map of a single road: lane_isolated, lane_unreachable and "
          "lane_dead_end are not judged");
      return;
    }
    report(MapFault::kLaneIsolated, islands, [&](LaneIndex lane) { return islands[lane] != mainland; });
    reportOneWay(MapFault::kLaneUnreachable, islands, mainland, reached(rounds, main, ways_));
    reportOneWay(MapFault::kLaneDeadEnd, islands, mainland, reached(rounds, main, turnedRound()));
  }

 private:
  void join(LaneIndex from, LaneIndex onto) {
    boost::add_edge(from, onto, ways_);
    boost::add_edge(from, onto, joined_);
  }

  static Parts partsOf(const Undirected& graph) {
    Parts parts(boost::num_vertices(graph));
    if (!parts.empty()) boost::connected_components(graph, parts.data());
    return parts;
  }

  Directed turnedRound() const {
    Directed turned(boost::num_vertices(ways_));
    for (auto [edge, end] = boost::edges(ways_); edge != end; ++edge) {
      boost::add_edge(boost::target(*edge, ways_), boost::source(*edge, ways_), turned);
    }
    return turned;
  }

  double lengthOf(const Parts& parts, int part) const {
    double length = 0.0;
    for (LaneIndex lane = 0; lane < parts.size(); ++lane) {
      if (parts[lane] == part && map_.lane(lane).isDrivable()) length += map_.lane(lane).length();
    }
    return length;
  }

  /// The part with the most metres to drive.
  int longest(const Parts& parts) const {
    std::vector<double> lengths(parts.size());
    for (LaneIndex lane = 0; lane < parts.size(); ++lane) {
      if (map_.lane(lane).isDrivable()) lengths[static_cast<std::size_t>(parts[lane])] += map_.lane(lane).length();
    }
    return static_cast<int>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  }

  static std::vector<bool> reached(const Parts& parts, int main, const Directed& ways) {
    std::vector<bool> is_reached(parts.size());
    std::vector<LaneIndex> open;
    const auto reach = [&](LaneIndex lane) {
      if (is_reached[lane]) return;
      is_reached[lane] = true;
      open.push_back(lane);
    };
    for (LaneIndex lane = 0; lane < parts.size(); ++lane) {
      if (parts[lane] == main) reach(lane);
    }
    while (!open.empty()) {
      const LaneIndex lane = open.back();
      open.pop_back();
      for (auto [edge, end] = boost::out_edges(lane, ways); edge != end; ++edge) {
        reach(static_cast<LaneIndex>(boost::target(*edge, ways)));
      }
    }
    return is_reached;
  }

  void reportOneWay(MapFault fault, const Parts& islands, int mainland, const std::vector<bool>& is_reached) {
    const auto is_cut_off = [&](LaneIndex lane) {
      const auto& reverse = map_.lane(lane).reverse;
      return islands[lane] == mainland && !is_reached[lane] && !(reverse && is_reached[*reverse]);
    };
    Undirected between(map_.lanes().size());
    for (auto [edge, end] = boost::edges(ways_); edge != end; ++edge) {
      const auto from = static_cast<LaneIndex>(boost::source(*edge, ways_));
      const auto onto = static_cast<LaneIndex>(boost::target(*edge, ways_));
      if (is_cut_off(from) && is_cut_off(onto)) boost::add_edge(from, onto, between);
    }
    report(fault, partsOf(between), is_cut_off);
  }

  /// One finding for each part that has lanes of which `is_meant` is true.
  template <class IsMeant>
  void report(MapFault fault, const Parts& parts, const IsMeant& is_meant) {
    std::vector<std::vector<LaneIndex>> lanes(parts.size());
    for (LaneIndex lane = 0; lane < parts.size(); ++lane) {
      const bool counts = map_.lane(lane).isDrivable() && !map_.lane(lane).is_reversed && is_meant(lane);
      if (counts) lanes[static_cast<std::size_t>(parts[lane])].push_back(lane);
    }
    for (const std::vector<LaneIndex>& part : lanes) {
      if (!part.empty()) report(fault, part);
    }
  }

  void report(MapFault fault, const std::vector<LaneIndex>& lanes) {
    double length = 0.0;
    for (const LaneIndex lane : lanes) length += map_.lane(lane).length();
    const Lane& first = map_.lane(lanes.front());
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < std::min(lanes.size(), kNamed); ++i) ids.push_back(map_.lane(lanes[i]).id);
    const std::string more = lanes.size() > 1 ? text(" and ", lanes.size() - 1, " more") : "";
    check_.faults->add(fault, ids, {first.center.pointAt(first.length() / 2.0), length}, first.id, more, ", ",
                       metres(length));
  }

  const MapUnderCheck& check_;
  const HdMap& map_;
  Directed ways_;
  Undirected joined_;
};

}  // namespace

void checkReach(const MapUnderCheck& check) { Reach(check).run(); }

}  // namespace external_command
