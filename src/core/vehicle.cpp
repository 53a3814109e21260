// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/vehicle.h"

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

void requireWithin(const char* key, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN
  throw InvalidParameter(text("vehicle/", key, " is ", value, "; it must lie in [", low, ", ", high, "]"));
}

}  // namespace

void VehicleParams::validate() const {
  requireWithin("wheelbase", wheelbase, 0.1, 30.0);
  requireWithin("width", width, 0.1, 10.0);
  requireWithin("front_overhang", front_overhang, 0.0, 15.0);
  requireWithin("rear_overhang", rear_overhang, 0.0, 15.0);
  requireWithin("min_turning_radius", min_turning_radius, 0.1, 100.0);
  requireWithin("max_speed", max_speed, 0.01, 100.0);
  requireWithin("max_reverse_speed", max_reverse_speed, 0.01, 100.0);
  requireWithin("max_acceleration", max_acceleration, 0.01, 20.0);
  requireWithin("max_deceleration", max_deceleration, 0.01, 20.0);
  requireWithin("max_lateral_acceleration", max_lateral_acceleration, 0.01, 20.0);
  requireWithin("max_steering_rate", max_steering_rate, 0.001, 20.0);
}

std::array<Point2d, 4> footprintAt(const VehicleParams& vehicle, const Pose2d& pose, double margin) {
  const Point2d ahead = unitVector(pose.heading);
  const Point2d left(-ahead.y(), ahead.x());
  const Point2d front = pose.position() + (vehicle.wheelbase + vehicle.front_overhang + margin) * ahead;
  const Point2d rear = pose.position() - (vehicle.rear_overhang + margin) * ahead;
  const Point2d side = (vehicle.width / 2.0 + margin) * left;
  return {rear - side, front - side, front + side, rear + side};
}

}  // namespace external_command
