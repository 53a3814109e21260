// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "external_command/core/path.h"
#include "external_command/core/vehicle.h"
#include "manoeuvre.h"

namespace external_command {

/// Whether a vehicle may drive the arcs from a pose.
using CurveCheck = std::function<bool(const Pose2d& from, const Arcs& arcs)>;

/// The curve with its jumps of curvature between gear changes made gradual, as short arcs; it still begins at `from`
/// and ends where it did. A ramp is as long as the steering takes at `speed` [m/s], and shorter where arcs are short or
/// `is_allowed` says no: the vehicle has to drive slower there, see limitSteering(). At a gear change the vehicle
/// stands, and turns its wheels before it goes on.
///
/// Linear ramps of curvature are clothoids (T. Fraichard and A. Scheuer, "From Reeds and Shepp's to
/// continuous-curvature paths", 2004); what they shift the end is taken out again by small changes of the arcs' lengths
/// and curvatures.
/// @param is_allowed  called for parts of the curve.
Arcs withSteeringRamps(const Pose2d& from, const Arcs& arcs, const VehicleParams& vehicle, double speed,
                       const CurveCheck& is_allowed);

}  // namespace external_command
