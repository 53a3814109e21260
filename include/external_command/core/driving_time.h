// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "external_command/core/path.h"
#include "external_command/core/vehicle.h"

namespace external_command {

/// How a path is to be driven slower than its limits: no faster than `most`, and that times `factor`. A factor that
/// asks for less than kLeastSpeed is counted with as that: nobody waits for what hardly moves.
struct SpeedOrder {
  double most = std::numeric_limits<double>::infinity();  ///< above 0 [m/s]
  double factor = 1.0;                                    ///< in (0, 1]
};

/// How long what is left of a path takes at its speeds, with a stop at each cusp and at the end. What the vehicle waits
/// for (a stop, a red light, the change of the gear) is not known here.
class DrivingTime {
 public:
  /// @param path  not empty, with speeds by limitSpeeds().
  DrivingTime(const VehicleParams& vehicle, std::shared_ptr<const Path> path, const SpeedOrder& order = {});

  /// From `s` along the path on [s]. The vehicle speeds up to what the path allows from its present `speed` [m/s].
  double left(double s, double speed) const;

 private:
  double limitAt(std::size_t point) const;
  double stretch(double from_speed, double to_speed, double length) const;

  const double acceleration_, deceleration_;  ///< [m/s^2]
  const std::shared_ptr<const Path> path_;
  const SpeedOrder order_;
  std::vector<double> to_end_;  ///< from each point [s]
};

}  // namespace external_command
