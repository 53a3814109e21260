// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "external_command/core/path.h"
#include "external_command/core/vehicle.h"
#include "manoeuvre.h"

namespace external_command {

/// The curve with its jumps of curvature between gear changes made gradual, as short arcs; it still begins at `from`
/// and ends where it did. A ramp is as long as the steering takes at `speed` [m/s], and shorter where arcs are short or
/// `isAllowed` says no: the vehicle has to drive slower there, see limitSteering(). At a gear change the vehicle
/// stands, and turns its wheels before it goes on.
///
/// Linear ramps of curvature are clothoids (T. Fraichard and A. Scheuer, "From Reeds and Shepp's to
/// continuous-curvature paths", 2004); what they shift the end is taken out again by small changes of the arcs' lengths
/// and curvatures.
Arcs withSteeringRamps(const Pose2d& from, const Arcs& arcs, const VehicleParams& vehicle, double speed,
                       const std::function<bool(const Arcs&)>& isAllowed);

/// Lowers the speed limits of a path to what its steering allows between gear changes.
void limitSteering(const VehicleParams& vehicle, Path* path);

}  // namespace external_command
