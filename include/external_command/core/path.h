// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "external_command/core/pose.h"
#include "external_command/core/vehicle.h"

namespace external_command {

enum class Direction : std::int8_t { kForward = 1, kReverse = -1 };

/// 1 forward, -1 in reverse.
inline int signOf(Direction direction) { return static_cast<int>(direction); }

/// One point of a reference path of the rear-axle centre.
struct ReferencePoint {
  double x = 0.0;        ///< [m]
  double y = 0.0;        ///< [m]
  double heading = 0.0;  ///< of the vehicle, not of the motion [rad]
  double kappa = 0.0;    ///< signed curvature of the vehicle's turn, positive to the vehicle's left [1/m]
  double s = 0.0;        ///< distance driven from the first point, never decreasing [m]
  /// Limit at this point [m/s]. On a piece of a path it is a cap of that piece's own, above 0; limitSpeeds() makes the
  /// limits of the whole of the caps.
  double speed = std::numeric_limits<double>::infinity();
  Direction direction = Direction::kForward;  ///< the gear in which the vehicle arrives here
  bool tool_on = false;                       ///< the vehicle arrives here working (coverage)

  Pose2d pose() const { return {x, y, heading}; }
};

using Path = std::vector<ReferencePoint>;

/// `first` and then `second`, whose first point is where `first` ends; `s` runs on. Caps of the speed stay as they are.
Path join(const Path& first, const Path& second);

/// The same for paths that the vehicle drives through without a stop: where the curvature steps between both, the
/// points on both sides of the step are capped to steeringSpeed().
Path join(const Path& first, const Path& second, const VehicleParams& vehicle);

/// The speed at which the wheels turn in time from one point to the next [m/s].
double steeringSpeed(const VehicleParams& vehicle, const ReferencePoint& from, const ReferencePoint& to);

/// Lowers the caps of a path to steeringSpeed() from point to point, but for gear changes: the vehicle stands there,
/// and turns its wheels meanwhile.
void limitSteering(const VehicleParams& vehicle, Path* path);

/// Sets `s` of every point from the positions.
void setArcLengths(Path* path);

/// Sets `kappa` from headings and positions, leg by leg between gear changes.
void setCurvatures(Path* path);

/// Makes limits of the caps of a whole path: lowers each point's `speed` to what bend (lateral acceleration) and gear
/// allow, and then to what can be braked for and sped up to from point to point. The last point, and every point at
/// which the gear changes, get 0: the vehicle stops there, and nowhere else. The first point may be passed at speed.
void limitSpeeds(const VehicleParams& vehicle, Path* path);

double reverseLength(const Path& path);  ///< [m]
unsigned gearChanges(const Path& path);

}  // namespace external_command
