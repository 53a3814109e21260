// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/reference_path.h"

#include <algorithm>
#include <cmath>

#include "course_geometry.h"
#include "external_command/core/text.h"
#include "smoothing.h"

namespace external_command {

namespace {

/// Kinks of the centre lines are rounded, and noise is taken out, over about this length. The path then stays within
/// 4 cm of a line that is sampled at 0.1 rad per point.
constexpr double kSmoothingLength = 1.2;  // [m]
constexpr double kPoint = 1e-3;           // [m]; a shorter route is one point
constexpr double kMaxLead = 100.0;        // samples beyond the ends

void requireWithin(const char* key, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN
  throw InvalidParameter(text(key, " is ", value, "; it must lie in [", low, ", ", high, "]"));
}

/// The route is as good as a point: the path stands there, in the lane's direction.
Path standingPath(const HdMap& map, const Route& route) {
  Path path;
  for (const auto& [lane, s] : {std::pair(route.steps.front().lane, route.steps.front().from_s),
                                std::pair(route.steps.back().lane, route.steps.back().to_s)}) {
    const Pose2d pose = map.lane(lane).center.poseAt(s);
    path.push_back({pose.x, pose.y, pose.heading});
  }
  path.back().s = (path[1].pose().position() - path[0].pose().position()).norm();
  return path;
}

/// The path through points[first] ... points[last]; the points beyond serve as neighbours.
Path pathThrough(const std::vector<Point2d>& points, std::size_t first, std::size_t last) {
  Path path(last - first + 1);
  for (std::size_t i = first; i <= last; ++i) {
    // The parabola through three points; at the ends, through the nearest three.
    const std::size_t middle = std::clamp<std::size_t>(i, 1, points.size() - 2);
    const Point2d bend = points[middle - 1] - 2.0 * points[middle] + points[middle + 1];
    const double off_middle = static_cast<double>(i) - static_cast<double>(middle);
    const Point2d slope = 0.5 * (points[middle + 1] - points[middle - 1]) + off_middle * bend;
    const double squared = std::max(slope.squaredNorm(), 1e-12);
    ReferencePoint& point = path[i - first];
    point.x = points[i].x();
    point.y = points[i].y();
    point.heading = headingOf(slope);
    point.kappa = cross(slope, bend) / (squared * std::sqrt(squared));
    if (i == first) continue;
    // As setArcLengths() would have it, but for a fraction of the time: arc over chord is 1 + (turn / 2)^2 / 6 + ...
    const ReferencePoint& previous = path[i - first - 1];
    const double chord = (points[i] - points[i - 1]).norm();
    const double half_turn = 0.25 * (previous.kappa + point.kappa) * chord;
    point.s = previous.s + chord * (1.0 + half_turn * half_turn / 6.0);
  }
  return path;
}

}  // namespace

void ReferencePathParams::validate() const {
  requireWithin("spacing", spacing, 0.05, 5.0);
  requireWithin("lane_change_length", lane_change_length, 1.0, 500.0);
  requireWithin("default_speed_limit", default_speed_limit, 0.1, 100.0);
}

Path referencePath(const HdMap& map, const Route& route, const VehicleParams& vehicle,
                   const ReferencePathParams& params, double target_speed) {
  const CourseGeometry geometry(map, route, vehicle, params);
  if (geometry.length() < kPoint) return standingPath(map, route);
  const auto intervals =
      static_cast<std::size_t>(std::max(2.0, std::ceil(geometry.length() / params.spacing - kPoint)));
  const double step = geometry.length() / static_cast<double>(intervals);
  const auto before = static_cast<std::size_t>(std::min(geometry.leadIn() / step, kMaxLead));
  const auto after = static_cast<std::size_t>(std::min(geometry.leadOut() / step, kMaxLead));
  const std::vector<CoursePoint> course = geometry.sample(step, before, intervals + after);
  std::vector<Point2d> points;
  points.reserve(course.size());
  for (const CoursePoint& point : course) points.push_back(point.position);
  smooth(kSmoothingLength / step, before, before + intervals, &points);

  Path path = pathThrough(points, before, before + intervals);
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i].speed = course[before + i].speed_limit;
    if (target_speed > 0.0) path[i].speed = std::min(path[i].speed, target_speed);
  }
  return path;
}

}  // namespace external_command
