// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "external_command/core/path.h"

namespace external_command {

/// How large a path may become, and how far from the vehicle it may begin. What is larger is refused, and before work
/// is done on it where that can be told.
struct PathBounds {
  double max_length = 100000.0;     ///< driven [m]
  std::size_t max_points = 200000;  ///< in one message

  double max_start_distance = 0.0;  ///< of a path along lanes to a vehicle off the lanes [m]; 0: any

  /// @throws InvalidParameter  out of range.
  void validate() const;

  /// @param length  driven [m]. @param points  of the path; as a number, since an estimate may exceed any integer.
  /// @throws InvalidRequest  either is too large; the text names both values, the limit and its parameter.
  void require(double length, double points) const;
  void require(const Path& path) const;
};

}  // namespace external_command
