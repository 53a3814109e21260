// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/core/vehicle.h"
#include "external_command/motion/region.h"

namespace external_command {

/// Distance [m] from the bare footprint at `pose` to the nearest obstacle, border or blocked cell of `region`, 0 where
/// it touches or overlaps one, written down as plainly as can be: what the collision checker is compared with. The
/// axle bounds do not count.
double referenceClearance(const VehicleParams& vehicle, const Pose2d& pose, const Region& region);

}  // namespace external_command
