// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/vehicle.h"

#include "external_command/core/parameter_range.h"

namespace external_command {

void VehicleParams::validate() const {
  requireParameter("vehicle/wheelbase", wheelbase, 0.1, 30.0);
  requireParameter("vehicle/width", width, 0.1, 10.0);
  requireParameter("vehicle/front_overhang", front_overhang, 0.0, 15.0);
  requireParameter("vehicle/rear_overhang", rear_overhang, 0.0, 15.0);
  requireParameter("vehicle/min_turning_radius", min_turning_radius, 0.1, 100.0);
  requireParameter("vehicle/max_speed", max_speed, kLeastSpeed, 100.0);
  requireParameter("vehicle/max_reverse_speed", max_reverse_speed, kLeastSpeed, 100.0);
  requireParameter("vehicle/max_acceleration", max_acceleration, 0.01, 20.0);
  requireParameter("vehicle/max_deceleration", max_deceleration, 0.01, 20.0);
  requireParameter("vehicle/max_lateral_acceleration", max_lateral_acceleration, 0.01, 20.0);
  requireParameter("vehicle/max_steering_rate", max_steering_rate, 0.001, 20.0);
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
