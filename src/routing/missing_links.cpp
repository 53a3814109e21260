// SPDX-License-Identifier: Apache-2.0
#include "missing_links.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kTouch = 1.0;      // [m]
constexpr double kSameWay = 1.6;    // [rad]; just over a right angle
constexpr std::size_t kPoll = 256;  // lanes between two looks at the cancel token

using Adjacency = std::vector<std::vector<LaneIndex>>;

/// Which lanes lead onto which, by links and lane changes; or, turned round, the other way.
Adjacency adjacencyOf(const LaneGraph& graph, bool turned_round) {
  Adjacency onto(graph.size());
  const auto add = [&](LaneIndex from, LaneIndex to) {
    turned_round ? onto[to].push_back(from) : onto[from].push_back(to);
  };
  for (LaneIndex lane = 0; lane < graph.size(); ++lane) {
    for (const LaneGraph::Link& next : graph.successors(lane)) add(lane, next.lane);
    for (const LaneGraph::Neighbour& other : graph.neighbours(lane)) add(lane, other.pair.b);
  }
  return onto;
}

std::vector<bool> reachedFrom(const std::vector<LanePoint>& places, const Adjacency& onto, const CancelToken& cancel) {
  std::vector<bool> is_reached(onto.size());
  std::vector<LaneIndex> open;
  const auto reach = [&](LaneIndex lane) {
    if (is_reached[lane]) return;
    is_reached[lane] = true;
    open.push_back(lane);
  };
  for (const LanePoint& place : places) reach(place.lane);
  for (std::size_t polls = 0; !open.empty(); ++polls) {
    if (polls % kPoll == 0) cancel.throwIfCancelled();
    const LaneIndex lane = open.back();
    open.pop_back();
    for (const LaneIndex next : onto[lane]) reach(next);
  }
  return is_reached;
}

/// The beginnings of lanes, by squares of `kTouch`.
class Beginnings {
 public:
  explicit Beginnings(const HdMap& map) : map_(map) {}

  void add(LaneIndex lane) { lanes_[keyOf(map_.lane(lane).center.points().front())].push_back(lane); }

  /// Calls `visit(lane, distance)` for those that begin within `kTouch` of the end of `lane`, and in its direction.
  template <class Visit>
  void visitAtEndOf(const Lane& lane, const Visit& visit) const {
    const Point2d end = lane.center.points().back();
    const double heading = lane.center.headingAt(lane.length());
    for (const double dx : {-kTouch, 0.0, kTouch}) {
      for (const double dy : {-kTouch, 0.0, kTouch}) {
        const auto found = lanes_.find(keyOf(end + Point2d(dx, dy)));
        if (found == lanes_.end()) continue;
        for (const LaneIndex other : found->second) {
          const Polyline& center = map_.lane(other).center;
          const double distance = (center.points().front() - end).norm();
          const bool fits = std::abs(angleBetween(heading, center.headingAt(0.0))) < kSameWay;
          if (fits && distance <= kTouch) visit(other, distance);
        }
      }
    }
  }

 private:
  static std::int64_t keyOf(const Point2d& point) {
    const auto x = static_cast<std::int64_t>(std::floor(point.x() / kTouch));
    const auto y = static_cast<std::int64_t>(std::floor(point.y() / kTouch));
    return x * 1000000007 + y;
  }

  const HdMap& map_;
  std::unordered_map<std::int64_t, std::vector<LaneIndex>> lanes_;
};

struct Touch {
  LaneIndex from = 0, onto = 0;
  double distance = 0.0;  // [m]
};

/// The ends of reached lanes that come nearest to the beginning of one of `wanted`.
std::optional<Touch> nearestTouch(const HdMap& map, const LaneGraph& graph, const std::vector<bool>& reached,
                                  const std::vector<bool>& wanted, const CancelToken& cancel) {
  Beginnings beginnings(map);
  for (LaneIndex lane = 0; lane < graph.size(); ++lane) {
    if (wanted[lane]) beginnings.add(lane);
  }
  std::optional<Touch> nearest;
  for (LaneIndex lane = 0; lane < graph.size(); ++lane) {
    if (lane % kPoll == 0) cancel.throwIfCancelled();
    if (!reached[lane]) continue;
    beginnings.visitAtEndOf(map.lane(lane), [&](LaneIndex onto, double distance) {
      if (!nearest || distance < nearest->distance) nearest = {lane, onto, distance};
    });
  }
  return nearest;
}

/// Two lanes abreast between which the line may not be crossed.
std::optional<Touch> closedLine(const HdMap& map, const std::vector<bool>& reached, const std::vector<bool>& wanted) {
  for (LaneIndex lane = 0; lane < reached.size(); ++lane) {
    if (!reached[lane]) continue;
    for (const auto* sides : {&map.lane(lane).left_forward, &map.lane(lane).right_forward}) {
      for (const LaneIndex other : *sides) {
        if (wanted[other]) return Touch{lane, other, 0.0};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::string missingLink(const HdMap& map, const LaneGraph& graph, const std::vector<LanePoint>& starts,
                        const std::vector<LanePoint>& goals, const CancelToken& cancel) {
  const std::vector<bool> reached = reachedFrom(starts, adjacencyOf(graph, false), cancel);
  std::vector<bool> wanted = reachedFrom(goals, adjacencyOf(graph, true), cancel);
  const auto id = [&](LaneIndex lane) { return map.lane(lane).id; };
  for (const BrokenLink& link : map.brokenLinks()) {
    if (!reached[link.from] || !wanted[link.onto]) continue;
    return text("; the link from lane ", id(link.from), " to lane ", id(link.onto), " is not driven, its ends lie ",
                metres(link.gap), " apart (~map/max_link_gap)");
  }
  const auto unlinked = [&](const Touch& touch) {
    return text("; lane ", id(touch.from), " ends where lane ", id(touch.onto), " begins, ", metres(touch.distance),
                " apart, but the map does not link them");
  };
  if (const auto touch = nearestTouch(map, graph, reached, wanted, cancel)) return unlinked(*touch);
  if (const auto line = closedLine(map, reached, wanted)) {
    return text("; lane ", id(line->onto), " lies beside lane ", id(line->from),
                ", but the line between them may not be crossed");
  }
  // More than one link may be missing: name the first.
  for (LaneIndex lane = 0; lane < graph.size(); ++lane) wanted[lane] = graph.isRoutable(lane) && !reached[lane];
  const auto touch = nearestTouch(map, graph, reached, wanted, cancel);
  return touch ? unlinked(*touch) : "";
}

}  // namespace external_command
