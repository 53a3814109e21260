// SPDX-License-Identifier: Apache-2.0
#include "support/route_matchers.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace external_command {

namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

constexpr double kExact = 1e-4;         // [m]
constexpr double kWidestLane = 8.0;     // [m] between centre lines that lie abreast
constexpr double kHeadingError = 0.02;  // [rad]

bool has(const std::vector<LaneIndex>& lanes, LaneIndex lane) {
  return std::find(lanes.begin(), lanes.end(), lane) != lanes.end();
}

const std::vector<LaneIndex>& neighbours(const Lane& lane, LaneChange side) {
  return side == LaneChange::kLeft ? lane.left_forward : lane.right_forward;
}

AssertionResult liesOnLane(const LaneRange& part, const HdMap& map) {
  const Lane& lane = map.lane(part.lane);
  if (!lane.isDrivable()) return AssertionFailure() << lane.id << " is not drivable";
  if (part.from_s >= -kExact && part.from_s <= part.to_s && part.to_s <= lane.length() + kExact) {
    return AssertionSuccess();
  }
  return AssertionFailure() << lane.id << " from " << part.from_s << " to " << part.to_s << " of " << lane.length();
}

/// Lanes may overlap: then the next one is entered where the one before ends.
bool meets(const Lane& lane, const LaneRange& next, const HdMap& map) {
  if (next.from_s < kExact) return true;
  const FrenetPoint end = map.lane(next.lane).center.project(lane.center.points().back());
  return std::abs(end.s - next.from_s) < kExact;
}

AssertionResult leadsOn(const LaneRange& from, const LaneRange& to, const HdMap& map) {
  const Lane& lane = map.lane(from.lane);
  const bool goes_on = from.lane == to.lane && std::abs(from.to_s - to.from_s) < kExact;
  const bool follows =
      has(lane.successors, to.lane) && std::abs(from.to_s - lane.length()) < kExact && meets(lane, to, map);
  if (goes_on || follows) return AssertionSuccess();
  return AssertionFailure() << lane.id << " at " << from.to_s << " of " << lane.length() << " does not lead to "
                            << map.lane(to.lane).id << " at " << to.from_s;
}

AssertionResult changesAbreast(const RouteStep& step, const RouteStep& next, const HdMap& map) {
  const Lane &old_lane = map.lane(step.lane), &new_lane = map.lane(next.lane);
  if (!has(neighbours(old_lane, step.change_after), next.lane)) {
    return AssertionFailure() << new_lane.id << " is no such neighbour of " << old_lane.id;
  }
  const double apart = (old_lane.center.pointAt(step.to_s) - new_lane.center.pointAt(next.from_s)).norm();
  if (apart > kWidestLane) {
    return AssertionFailure() << old_lane.id << " at " << step.to_s << " is " << apart << " m from " << new_lane.id
                              << " at " << next.from_s;
  }
  if (step.change_onto.empty()) return AssertionFailure() << "nothing lies beside the change from " << old_lane.id;
  const LaneRange& last = step.change_onto.back();
  if (last.lane == next.lane && std::abs(last.to_s - next.from_s) < kExact) return AssertionSuccess();
  return AssertionFailure() << "beside the change from " << old_lane.id << " is " << map.lane(last.lane).id << " to "
                            << last.to_s << ", not " << new_lane.id << " at " << next.from_s;
}

/// The lanes beside the room of the change after step `index`.
AssertionResult isBesideItsRoom(const Route& route, std::size_t index, const HdMap& map) {
  const RouteStep& change = route.steps[index];
  double room = change.change_room;
  std::vector<LaneIndex> beside;
  for (std::size_t i = index + 1; i-- > 0 && room > kExact;) {
    const RouteStep& step = route.steps[i];
    if (i < index && step.change_after != LaneChange::kNone) {
      return AssertionFailure() << "the room of the change from " << map.lane(change.lane).id << " reaches back "
                                << room << " m beyond the change from " << map.lane(step.lane).id;
    }
    const auto& lanes = neighbours(map.lane(step.lane), change.change_after);
    beside.insert(beside.end(), lanes.begin(), lanes.end());
    room -= step.to_s - step.from_s;
  }
  if (room > kExact) return AssertionFailure() << "the room reaches back beyond the start";
  for (std::size_t i = 0; i < change.change_onto.size(); ++i) {
    const LaneRange& part = change.change_onto[i];
    if (const auto on_lane = liesOnLane(part, map); !on_lane) return on_lane;
    if (part.to_s - part.from_s > kExact && !has(beside, part.lane)) {
      return AssertionFailure() << map.lane(part.lane).id << " is not beside the room";
    }
    if (i == 0) continue;
    if (const auto leads = leadsOn(change.change_onto[i - 1], part, map); !leads) return leads;
  }
  return AssertionSuccess();
}

AssertionResult isFree(const LaneRange& part, const HdMap& map, const std::vector<LaneRange>& black_list) {
  for (const LaneRange& range : black_list) {
    if (range.lane != part.lane || part.from_s > range.to_s || part.to_s < range.from_s) continue;
    return AssertionFailure() << map.lane(part.lane).id << " from " << part.from_s << " to " << part.to_s
                              << " touches the black list from " << range.from_s << " to " << range.to_s;
  }
  return AssertionSuccess();
}

LaneRange rangeOf(const RouteStep& step) { return {step.lane, step.from_s, step.to_s}; }

}  // namespace

AssertionResult isConnected(const Route& route, const HdMap& map) {
  if (route.steps.empty()) return AssertionFailure() << "the route has no steps";
  for (std::size_t i = 0; i < route.steps.size(); ++i) {
    const RouteStep& step = route.steps[i];
    if (const auto on_lane = liesOnLane(rangeOf(step), map); !on_lane) return on_lane;
    const bool is_last = i + 1 == route.steps.size();
    if (step.change_after == LaneChange::kNone) {
      if (is_last) return AssertionSuccess();
      if (const auto leads = leadsOn(rangeOf(step), rangeOf(route.steps[i + 1]), map); !leads) return leads;
      continue;
    }
    if (is_last) return AssertionFailure() << "the route ends with a lane change";
    if (const auto abreast = changesAbreast(step, route.steps[i + 1], map); !abreast) return abreast;
    if (const auto beside = isBesideItsRoom(route, i, map); !beside) return beside;
  }
  return AssertionSuccess();
}

AssertionResult changesHaveRoom(const Route& route, const HdMap& map, double radius) {
  for (std::size_t i = 0; i + 1 < route.steps.size(); ++i) {
    const RouteStep& step = route.steps[i];
    if (step.change_after == LaneChange::kNone) continue;
    double room = 0.0;
    for (const LaneRange& part : step.change_onto) room += part.to_s - part.from_s;
    const Lane &old_lane = map.lane(step.lane), &new_lane = map.lane(route.steps[i + 1].lane);
    const double offset = new_lane.center.project(old_lane.center.pointAt(step.to_s)).distance;
    const double least = offset < 2.0 * radius ? std::sqrt(offset * (4.0 * radius - offset)) : 2.0 * radius;
    if (room < least - kExact) {
      return AssertionFailure() << "the change from " << old_lane.id << " to " << new_lane.id << ", " << offset
                                << " m beside it, has " << room << " m of the " << least << " m it takes at least";
    }
  }
  return AssertionSuccess();
}

AssertionResult avoids(const Route& route, const HdMap& map, const std::vector<LaneRange>& black_list) {
  for (const RouteStep& step : route.steps) {
    if (const auto free = isFree(rangeOf(step), map, black_list); !free) return free;
    for (const LaneRange& part : step.change_onto) {
      if (const auto free = isFree(part, map, black_list); !free) return free;
    }
  }
  return AssertionSuccess();
}

AssertionResult beginsAndEndsAsAsked(const Route& route, const RouteQuery& query) {
  if (route.start >= query.starts.size() || route.goal >= query.goals.size()) {
    return AssertionFailure() << "start " << route.start << " or goal " << route.goal << " was not asked for";
  }
  const LanePoint &start = query.starts[route.start], &goal = query.goals[route.goal];
  const RouteStep &first = route.steps.front(), &last = route.steps.back();
  if (first.lane != start.lane || std::abs(first.from_s - start.s) > kExact) {
    return AssertionFailure() << "begins on lane " << first.lane << " at " << first.from_s;
  }
  const bool was_there = route.distance == 0.0 && route.steps.size() == 1;  // the goal may lie a little behind
  if (!was_there && (last.lane != goal.lane || std::abs(last.to_s - goal.s) > 0.002)) {
    return AssertionFailure() << "ends on lane " << last.lane << " at " << last.to_s << ", not " << goal.s;
  }
  return AssertionSuccess();
}

AssertionResult isContinuous(const Path& path, double spacing) {
  if (path.size() < 2) return AssertionFailure() << path.size() << " points";
  for (std::size_t i = 1; i < path.size(); ++i) {
    const ReferencePoint &a = path[i - 1], &b = path[i];
    const double chord = (b.pose().position() - a.pose().position()).norm();
    if (!b.pose().isFinite() || !std::isfinite(b.kappa)) return AssertionFailure() << "point " << i << " is not finite";
    if (chord > spacing) return AssertionFailure() << "point " << i << " is " << chord << " m from its predecessor";
    const double driven = b.s - a.s;
    if (driven < chord - kExact || driven > 1.1 * chord + kExact) {
      return AssertionFailure() << "s of point " << i << " rises by " << driven << " m over " << chord << " m";
    }
    const double turn = angleBetween(a.heading, b.heading);
    if (std::abs(turn - 0.5 * (a.kappa + b.kappa) * driven) > kHeadingError) {
      return AssertionFailure() << "point " << i << " turns by " << turn << " rad, its curvature says "
                                << 0.5 * (a.kappa + b.kappa) * driven;
    }
    const Point2d ahead = unitVector(a.heading + 0.5 * turn);
    const double sideways = cross(ahead, b.pose().position() - a.pose().position());
    if (std::abs(sideways) > kHeadingError * spacing) {
      return AssertionFailure() << "point " << i << " moves sideways by " << sideways << " m";
    }
  }
  if (path.back().speed > 0.0) return AssertionFailure() << "ends at " << path.back().speed << " m/s";
  return AssertionSuccess();
}

AssertionResult staysNear(const Path& path, const Route& route, const HdMap& map, double distance) {
  std::set<LaneIndex> lanes;
  for (const RouteStep& step : route.steps) {
    lanes.insert(step.lane);
    for (const LaneRange& part : step.change_onto) lanes.insert(part.lane);
  }
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point2d point = path[i].pose().position();
    const bool is_near = std::any_of(lanes.begin(), lanes.end(), [&](LaneIndex lane) {
      return map.lane(lane).center.project(point).distance <= distance;
    });
    if (!is_near) return AssertionFailure() << "point " << i << " is more than " << distance << " m from the lanes";
  }
  return AssertionSuccess();
}

std::string laneIds(const Route& route, const HdMap& map) {
  std::string ids;
  for (const RouteStep& step : route.steps) ids += (ids.empty() ? "" : " ") + map.lane(step.lane).id;
  return ids;
}

std::string drawn(const std::vector<RouteSegment>& segments, const HdMap& map) {
  std::string text;
  for (const RouteSegment& segment : segments) {
    std::string passages;
    for (const RoutePassage& passage : segment.passages) {
      std::string lanes;
      for (const LaneRange& lane : passage.lanes) lanes += (lanes.empty() ? "" : " ") + map.lane(lane.lane).id;
      passages += (passages.empty() ? "" : "|") + lanes + (passage.can_exit ? "*" : "");
    }
    text += (text.empty() ? "{" : " {") + passages + "}";
  }
  return text;
}

}  // namespace external_command
