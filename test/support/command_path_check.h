// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "external_command/core/path.h"

namespace external_command {

struct CommandPathLimits {
  double max_gap = 0.6;          ///< between neighbouring points [m]
  double start_distance = 0.01;  ///< from the vehicle to the first point [m]
  double start_turn = 0.02;      ///< the same of the heading [rad]
  bool curvature = true;         ///< false: a warning tells where the path bends more than the vehicle can
};

/// Whether a controller may rely on a path as it is sent: it begins at `start`, where given; positions, headings, s and
/// curvature go on without a jump, in the gear stated; the curvature and the speeds are within the vehicle's limits,
/// can be braked for and sped up to; the vehicle stops at the end and where the gear changes, and nowhere else.
/// @return what is wrong first, and where; empty: nothing.
std::string commandPathFault(const Path& path, const VehicleParams& vehicle,
                             const std::optional<Pose2d>& start = std::nullopt, const CommandPathLimits& limits = {});

}  // namespace external_command
