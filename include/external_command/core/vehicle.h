// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "external_command/core/pose.h"

namespace external_command {

/// A slower vehicle stands: no speed to drive at is set, or asked for, below this [m/s].
constexpr double kLeastSpeed = 0.01;

/// Size and limits of a car-like vehicle. The reference point is the rear-axle centre (`base_link`).
struct VehicleParams {
  double wheelbase = 2.8;                 ///< [m]
  double width = 2.0;                     ///< over all [m]
  double front_overhang = 0.95;           ///< from the front axle to the bumper [m]
  double rear_overhang = 0.95;            ///< from the rear axle to the bumper [m]
  double min_turning_radius = 5.0;        ///< of the rear-axle centre at full lock [m]
  double max_speed = 15.0;                ///< forward [m/s]
  double max_reverse_speed = 2.0;         ///< [m/s], positive
  double max_acceleration = 1.5;          ///< [m/s^2]
  double max_deceleration = 2.5;          ///< [m/s^2], positive
  double max_lateral_acceleration = 1.5;  ///< sets the speed limit in bends [m/s^2]
  double max_steering_rate = 0.5;         ///< of the front wheels [rad/s]

  double length() const { return rear_overhang + wheelbase + front_overhang; }
  double maxKappa() const { return 1.0 / min_turning_radius; }

  /// How far it drives at `speed` [m/s], at most, while it turns its wheels from straight on to full lock [m].
  double rampLength(double speed) const { return speed * wheelbase * maxKappa() / max_steering_rate; }

  /// @throws InvalidParameter  a value is not finite or out of range; the text names it as `vehicle/<key>`.
  void validate() const;
};

/// Corners of the footprint at `pose`, grown by `margin` [m] on every side: rear right, front right, front left,
/// rear left (counter-clockwise).
std::array<Point2d, 4> footprintAt(const VehicleParams& vehicle, const Pose2d& pose, double margin);

}  // namespace external_command
