// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "external_command/core/path.h"
#include "external_command/core/vehicle.h"
#include "manoeuvre.h"

namespace external_command {

/// Whether a vehicle may drive the arcs from a pose.
using CurveCheck = std::function<bool(const Pose2d& from, const Arcs& arcs)>;

struct RampShape {
  double speed;        ///< that the vehicle can keep while it turns its wheels [m/s]
  double step = 0.05;  ///< of a ramp, that is driven as one arc [m]
};

/// Where a curve has to begin and end, if not exactly where its arcs do.
struct ExactEnds {
  std::optional<Pose2d> begin;
  std::optional<Pose2d> end;
};

/// The curve with its jumps of curvature between gear changes made gradual, as short arcs; it still begins at `from`
/// and ends where it did, or at the exact ends near these. A ramp is as long as the steering takes at the speed of
/// `shape`, and shorter where arcs are short or `is_allowed` says no: the vehicle has to drive slower there,
/// see limitSteering(). At a gear change the vehicle stands, and turns its wheels before it goes on.
///
/// Linear ramps of curvature are clothoids (T. Fraichard and A. Scheuer, "From Reeds and Shepp's to
/// continuous-curvature paths", 2004); what they shift the end is taken out again by small changes of the arcs' lengths
/// and curvatures.
/// @param is_allowed  called for parts of the curve.
/// @param stop        once it is true, parts that have no ramps yet stay as they are.
/// @return  nullopt where an exact end cannot be met; never without any.
std::optional<Arcs> withSteeringRamps(const Pose2d& from, const Arcs& arcs, const ExactEnds& ends,
                                      const VehicleParams& vehicle, const RampShape& shape,
                                      const CurveCheck& is_allowed, const std::function<bool()>& stop);

}  // namespace external_command
