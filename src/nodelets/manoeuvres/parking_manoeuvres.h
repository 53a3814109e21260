// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "manoeuvre_planner.h"

namespace external_command {

/// Where a vehicle may manoeuvre between `core` (a parking space or an area) and the lanes around it: both surfaces,
/// the gap between them closed as far as needed for `on_lane` to be inside; the other parking spaces are obstacles.
/// @throws Cancelled
Region::Parts surfaceWith(const HdMap& map, const Polygon& core, const Pose2d& on_lane, const CancelToken& cancel);

/// Replaces the end of the plan's path by the cheapest way into one of `goals` from a place on it, found by `deadline`.
/// @param onward  how it goes on from each of the goals, as EndStates::goals.
/// @throws GoalBlocked, NoPath, PlanningTimeout, Cancelled
void leaveRouteFor(const std::vector<Pose2d>& goals, const std::vector<std::optional<EndState>>& onward,
                   const Region& region, const ManoeuvrePlanner& planner, const Deadline& deadline,
                   const CancelToken& cancel, MotionPlan* plan);

/// Where the vehicle stands off the lanes, in a parking space, an area or elsewhere, the path begins with a manoeuvre
/// from there onto the route; where none is found by `deadline` the path begins on the lane, with a warning that
/// tells the distance.
/// @throws Cancelled
/// @throws NoPath  it would begin farther away than `routing/max_path_start_distance`.
void leaveParkingPlace(const ProcessContext& context, const Pose2d& vehicle, const ManoeuvrePlanner& planner,
                       const Deadline& deadline, const CancelToken& cancel, MotionPlan* plan);

}  // namespace external_command
