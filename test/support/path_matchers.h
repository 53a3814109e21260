// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "external_command/core/path.h"
#include "external_command/motion/region.h"

namespace external_command {

/// How exactly a path has to be drivable.
struct PathLimits {
  double max_gap = 0.05;     ///< between neighbouring points [m]
  double curvature = 1.001;  ///< times the vehicle's largest
  double slip = 1e-4;        ///< sideways within a step [m]
};

/// Whether a car can follow the path: neighbouring points lie close together and are joined by one arc that is not too
/// tight, driven in the gear that the point says; `s` runs on.
testing::AssertionResult isDrivable(const Path& path, const VehicleParams& vehicle, const PathLimits& limits = {});

/// Whether the footprint stays at least `clearance` [m] away from everything in the region, and the rear axle within
/// the axle bounds, at poses between which no corner moves more than 1 cm. Compares with the plain reference.
testing::AssertionResult staysClear(const Path& path, const VehicleParams& vehicle, const Region& region,
                                    double clearance);

/// Whether the path ends are these poses to 1 mm and 0.01 degrees.
testing::AssertionResult joins(const Path& path, const Pose2d& start, const Pose2d& goal);

}  // namespace external_command
