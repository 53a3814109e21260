// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/drive_limits.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

bool cross(const Point2d& a, const Point2d& b, const Point2d& c, const Point2d& d) {
  const auto side = [](const Point2d& from, const Point2d& to, const Point2d& point) {
    return external_command::cross(to - from, point - from);
  };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

bool isInside(const std::array<Point2d, 4>& footprint, const Polygon& fence) {
  const auto isIn = [&](const Point2d& corner) { return fence.contains(corner); };
  if (!std::all_of(footprint.begin(), footprint.end(), isIn)) return false;
  const std::vector<Point2d>& points = fence.points();
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    for (std::size_t k = 0; k < footprint.size(); ++k) {
      if (cross(points[j], points[i], footprint[k], footprint[(k + 1) % footprint.size()])) return false;
    }
  }
  return true;
}

/// Of the rear axle's centre to the farthest corner.
double reachOf(const VehicleParams& vehicle) {
  double reach = 0.0;
  for (const Point2d& corner : footprintAt(vehicle, {}, 0.0)) reach = std::max(reach, corner.norm());
  return reach;
}

void requireNotNegative(double value, const char* name) {
  if (value >= 0.0 && std::isfinite(value)) return;
  throw InvalidParameter(text(name, " is ", value, "; it must be finite, and not negative (0: no limit)"));
}

void requireMaxSpeed(double speed) {
  requireNotNegative(speed, "max_speed");
  if (speed == 0.0 || speed >= kLeastSpeed) return;
  throw InvalidParameter(text("max_speed is ", speed, "; it must be ", kLeastSpeed, " m/s at least, or 0 (no limit)"));
}

}  // namespace

void DriveLimits::validate() const {
  requireNotNegative(max_goal_distance, "max_goal_distance");
  requireMaxSpeed(max_speed);
}

void DriveLimits::requireSpeed(double target_speed) const {
  if (max_speed <= 0.0 || target_speed <= max_speed) return;
  throw InvalidRequest(
      text("target_speed is ", target_speed, " m/s; the limit is ", max_speed, " m/s (~limits/max_speed)"));
}

void DriveLimits::requireGoal(const Point2d& vehicle, const Point2d& goal) const {
  const double distance = (goal - vehicle).norm();
  if (max_goal_distance <= 0.0 || distance <= max_goal_distance) return;
  throw InvalidRequest(text("the goal ", at(goal), " is ", metres(distance), " from the vehicle at ", at(vehicle),
                            "; the limit is ", metres(max_goal_distance), " (~limits/max_goal_distance)"));
}

void DriveLimits::requireInside(const Path& path, const VehicleParams& vehicle, const CancelToken& cancel) const {
  if (!geofence) return;
  const double reach = reachOf(vehicle);
  double inside_up_to = -1.0;  // along the path [m]: far from the border there is nothing to look at for a while
  for (const ReferencePoint& point : path) {
    if (point.s < inside_up_to) continue;
    cancel.throwIfCancelled();
    if (!isInside(footprintAt(vehicle, point.pose(), 0.0), *geofence)) {
      throw InvalidRequest(text("the path leaves the geofence at ", at(point.pose().position()), ", ", metres(point.s),
                                " from its beginning (~limits/geofence)"));
    }
    inside_up_to = point.s + geofence->distanceToBorder(point.pose().position()) - reach;
  }
}

}  // namespace external_command
