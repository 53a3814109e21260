// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/path.h"
#include "external_command/core/pose.h"

namespace external_command {

/// A stretch of constant curvature, driven in one gear.
struct ArcSegment {
  double length = 0.0;  ///< signed: negative in reverse [m]
  double kappa = 0.0;   ///< signed, positive to the vehicle's left whatever the gear [1/m]
};

constexpr double kEmptyArc = 1e-9;  ///< what is shorter is rounding, and left out [m]

/// One way to steer from a pose to another. `arcs` is empty where the two poses are the same.
struct SteeringCurve {
  std::vector<ArcSegment> arcs;
  double length = 0.0;  ///< driven, of both gears together [m]
  unsigned gear_changes = 0;
  double cost = 0.0;  ///< length + gear_changes * gear_change_cost [m]
};

/// Shortest way without obstacles for a car that drives forward and backward and turns no tighter than `radius` [m],
/// which must be positive: at most five arcs of curvature 0 or +-1/radius (J. Reeds and L. Shepp, "Optimal paths for a
/// car that goes both forwards and backwards", 1990). O(1), about a microsecond.
std::vector<ArcSegment> shortestReedsShepp(const Pose2d& from, const Pose2d& to, double radius);

/// Length [m] of that way.
double reedsSheppLength(const Pose2d& from, const Pose2d& to, double radius);

/// Every word of the Reeds-Shepp set that joins the poses, cheapest first. Never empty.
/// @param gear_change_cost  price of a gear change, as length [m].
std::vector<SteeringCurve> reedsSheppCurves(const Pose2d& from, const Pose2d& to, double radius,
                                            double gear_change_cost);

/// Shortest way forward only (L. Dubins, 1957): at most three arcs.
std::vector<ArcSegment> shortestDubins(const Pose2d& from, const Pose2d& to, double radius);

/// Every Dubins word that joins the poses, shortest first. Never empty.
std::vector<SteeringCurve> dubinsCurves(const Pose2d& from, const Pose2d& to, double radius);

/// The pose after `driven` [m, not negative] of `arc`, in the arc's gear.
Pose2d advance(const Pose2d& from, const ArcSegment& arc, double driven);

/// The pose at the end of `arc`.
Pose2d advance(const Pose2d& from, const ArcSegment& arc);

/// The pose at the end of all `arcs`.
Pose2d endOf(const Pose2d& from, const std::vector<ArcSegment>& arcs);
inline Pose2d advance(const Pose2d& from, const std::vector<ArcSegment>& arcs) { return endOf(from, arcs); }

/// Points at most `spacing` [m] apart along `arcs`, one at every joint, the first at `from`, the last exactly at the
/// curve's end; with curvature, direction and `s`. `speed` is left 0.
/// At a joint the point belongs to the arc that ends there. Empty arcs (below 1e-9 m) are skipped.
Path sampleArcs(const Pose2d& from, const std::vector<ArcSegment>& arcs, double spacing);

}  // namespace external_command
