// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "external_command/core/path.h"
#include "external_command/core/vehicle.h"
#include "external_command/free_space/free_space_planner.h"

namespace external_command {

/// Where a manoeuvre leaves a path, or gets onto it.
struct PathJoint {
  std::size_t point;  ///< of the path
  std::size_t bend;   ///< point up to which the path may be bent, before or behind it; the same: it stays as it is
  std::optional<EndState> state;  ///< how the vehicle passes `point`; unset where it begins or ends there
};

/// How much of a path before or behind a manoeuvre is to be bent so that steering is gradual there [m]; 0 where that is
/// not wished.
double bendLength(const VehicleParams& vehicle, const FreeSpaceParams& params);

/// @param length  of the path before it that may be bent, at least, without a gear change [m].
PathJoint leavingAt(const Path& path, std::size_t index, double length);

/// @param length  of the path behind it that may be bent, at least, without a gear change [m].
PathJoint joiningAt(const Path& path, std::size_t index, double length);

}  // namespace external_command
