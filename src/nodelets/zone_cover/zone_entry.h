// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/vehicle.h"
#include "external_command/coverage/coverage_planner.h"

namespace external_command {

/// Poses near `from`, the nearest first and at most 8, at which the whole footprint lies in the zone: where a vehicle
/// that comes from a lane may begin to sweep.
/// @throws NoPath  there is none within 40 m.
/// @throws Cancelled
std::vector<Pose2d> zoneEntries(const CoverageArea& zone, const VehicleParams& vehicle, double margin,
                                const Pose2d& from, const CancelToken& cancel);

}  // namespace external_command
