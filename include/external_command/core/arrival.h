// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/core/path.h"

namespace external_command {

/// When a vehicle counts as standing at the end of its path.
struct ArrivalParams {
  double along = 0.5;    ///< from the end, in its direction [m]
  double across = 0.5;   ///< to either side [m]
  double heading = 0.2;  ///< off the end's [rad]
  double rest = 1.0;     ///< for which it must have stood [s]

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

/// What the vehicle's poses tell of its motion. Fed with them, at a few per second or more.
class VehicleMotion {
 public:
  /// @param now  of any steady clock [s].
  void update(const Pose2d& pose, double now);

  double speed() const { return speed_; }  ///< without sign, of the last half second [m/s]

  /// For how long the vehicle has stood; 0 while it moves [s].
  double rest(double now) const { return is_known_ ? now - moved_at_ : 0.0; }

 private:
  struct Sample {
    Pose2d pose;
    double time = 0.0;
  };

  bool is_known_ = false;
  Sample anchor_;          ///< where it stands, or stood last
  double moved_at_ = 0.0;  ///< [s]
  Sample window_;          ///< begin of the time over which the speed is taken
  double speed_ = 0.0;     ///< [m/s]
};

/// How the vehicle stands to the end of a path.
struct EndError {
  double along = 0.0;    ///< beyond the end, negative before it [m]
  double across = 0.0;   ///< to the left [m]
  double heading = 0.0;  ///< [rad]
};

EndError endError(const Pose2d& vehicle, const ReferencePoint& end);

bool isWithin(const EndError& error, const ArrivalParams& params);

}  // namespace external_command
