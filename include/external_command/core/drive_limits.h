// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "external_command/core/cancel_token.h"
#include "external_command/core/path.h"
#include "external_command/core/polygon.h"

namespace external_command {

/// Where and how fast this vehicle may be sent, whatever is asked for. For slips of callers; 0 and nullopt: no limit.
struct DriveLimits {
  std::optional<Polygon> geofence;  ///< that every path keeps the whole vehicle inside, in the map frame
  double max_goal_distance = 0.0;   ///< from where the vehicle is to where it is sent, straight [m]
  double max_speed = 0.0;           ///< [m/s], kLeastSpeed at least

  /// @throws InvalidParameter  out of range.
  void validate() const;

  /// Each throws InvalidRequest; the text tells place or value, limit, and parameter. requireInside() throws Cancelled
  /// where `cancel` was raised.
  void requireSpeed(double target_speed) const;
  void requireGoal(const Point2d& vehicle, const Point2d& goal) const;
  void requireInside(const Path& path, const VehicleParams& vehicle, const CancelToken& cancel = {}) const;
};

}  // namespace external_command
