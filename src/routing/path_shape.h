// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/core/vehicle.h"

namespace external_command {

/// From 0 to 1 with neither slope nor curvature at the ends.
inline double quintic(double t) { return t * t * t * (10.0 + t * (-15.0 + t * 6.0)); }

constexpr double kQuinticPeak = 5.7735;  ///< largest second derivative of it: 10 / sqrt(3)

/// Of the curvature that the steering can follow at a crawl [1/m^2].
inline double fastestChangeOfKappa(const VehicleParams& vehicle) {
  constexpr double kCrawl = 2.0;  // [m/s]
  return vehicle.max_steering_rate / (kCrawl * vehicle.wheelbase);
}

}  // namespace external_command
