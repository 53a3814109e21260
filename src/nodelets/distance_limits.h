// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/pose.h"
#include "external_command/ros/parameters.h"

namespace external_command {

/// How far from the vehicle a place of a command may lie.
struct DistanceLimits {
  double warning = 0.0;  ///< farther away it is warned about [m]
  double refusal = 0.0;  ///< farther away it is refused [m]; 0: it never is

  /// Reads `NAME_distance_warning` and `max_NAME_distance`. @throws InvalidParameter
  void read(const ParameterReader& reader, const std::string& name);

  /// @param what  begins the text: "the path begins at".
  /// @param name  as of read(): the text names the parameters.
  /// @throws InvalidRequest  `place` is too far away.
  void check(const std::string& what, const std::string& name, const Point2d& place, const Point2d& vehicle,
             std::vector<std::string>* warnings) const;
};

}  // namespace external_command
