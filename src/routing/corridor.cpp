// SPDX-License-Identifier: Apache-2.0
#include "corridor.h"

#include <algorithm>

namespace external_command {

namespace {

constexpr double kMargin = 0.1;                     // kept to the boundaries [m]
constexpr double kNarrowest = 0.5, kWidest = 10.0;  // half widths of lanes beyond are not believed [m]

constexpr double kMostSlanting = 0.6;  // cosine of the angle between path and lane that is reckoned with

double believed(double half_width) { return std::clamp(half_width, kNarrowest, kWidest); }

bool hasCurb(const LaneBoundary& boundary) {
  return std::any_of(boundary.types.begin(), boundary.types.end(),
                     [](const BoundaryTypeChange& change) { return change.type == BoundaryType::kCurb; });
}

}  // namespace

/// Of the neighbour in the same direction that a vehicle may get onto at that side; 0 where there is none [m].
double Corridor::neighbourWidth(const Lane& lane, double s, LaneChange side) const {
  const bool left = side == LaneChange::kLeft;
  if (hasCurb(left ? lane.left : lane.right)) return 0.0;
  for (const LaneIndex index : left ? lane.left_forward : lane.right_forward) {
    const Lane& neighbour = map_.lane(index);
    if (!neighbour.isDrivable()) continue;
    const double abreast = s / lane.length() * neighbour.length();
    return believed(neighbour.leftWidthAt(abreast)) + believed(neighbour.rightWidthAt(abreast));
  }
  return 0.0;
}

void Corridor::limit(const CoursePoint& place, FitPoint* point) const {
  const double half = vehicle_.width / 2.0 + kMargin;
  const auto offsetOf = [&](const LanePoint& lane) {
    return (map_.lane(lane.lane).center.pointAt(lane.s) - point->base).dot(point->normal);
  };
  const bool changes = place.onto.lane != place.lane.lane;
  const double own = changes ? offsetOf(place.lane) : (place.position - point->base).dot(point->normal);
  const double other = changes ? offsetOf(place.onto) : own;
  const LanePoint& right = other < own ? place.onto : place.lane;
  const LanePoint& left = other < own ? place.lane : place.onto;
  const Lane &right_lane = map_.lane(right.lane), &left_lane = map_.lane(left.lane);
  // Where the path cuts a corner it is farther to the boundary than straight across the lane.
  const auto slant = [&](const Lane& lane, double s) {
    const Point2d way = unitVector(lane.center.headingAt(s));
    return std::max(kMostSlanting, std::abs(cross(way, point->normal)));
  };
  const double right_room = believed(right_lane.rightWidthAt(right.s)) / slant(right_lane, right.s) - half;
  const double left_room = believed(left_lane.leftWidthAt(left.s)) / slant(left_lane, left.s) - half;
  const double right_end = std::min(own, other), left_end = std::max(own, other);
  point->wished_low = right_end - std::max(0.0, right_room);
  point->wished_high = left_end + std::max(0.0, left_room);
  // The margin is a wish as well: it is given up before the vehicle's curvature is.
  point->low =
      right_end - std::max(0.0, right_room + kMargin) - neighbourWidth(right_lane, right.s, LaneChange::kRight);
  point->high = left_end + std::max(0.0, left_room + kMargin) + neighbourWidth(left_lane, left.s, LaneChange::kLeft);
}

double Corridor::narrowest(const CoursePoint& place) const {
  const Lane& lane = map_.lane(place.lane.lane);
  return believed(std::min(lane.leftWidthAt(place.lane.s), lane.rightWidthAt(place.lane.s)));
}

double Corridor::narrowestOf(LaneIndex index) const {
  const Lane& lane = map_.lane(index);
  if (lane.left_widths.empty() || lane.right_widths.empty()) return kNarrowest;
  double least = kWidest;
  for (const auto* widths : {&lane.left_widths, &lane.right_widths}) {
    for (const WidthSample& sample : *widths) least = std::min(least, sample.width);
  }
  return believed(least);
}

double Corridor::frontExcess(const CoursePoint& place, double kappa) const {
  const Lane& lane = map_.lane(place.lane.lane);
  const double front = vehicle_.wheelbase + vehicle_.front_overhang;
  const double room = kappa > 0.0 ? lane.rightWidthAt(place.lane.s) : lane.leftWidthAt(place.lane.s);
  return 0.5 * std::abs(kappa) * front * front + vehicle_.width / 2.0 - believed(room);
}

}  // namespace external_command
