// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "manoeuvre_planner.h"

namespace external_command {

/// How a vehicle stands in a parking space.
enum class ParkingDirection { kNoseIn, kBackingIn, kCheaper };

/// `parking_direction`: "nose_in", "backing_in" or "cheaper". @throws InvalidParameter
ParkingDirection readParkingDirection(const ParameterReader& reader);

/// Poses of the rear-axle centre with the vehicle in the middle of the space, or, where that is too short for vehicle
/// and `margin` [m], sticking out of it towards the lane.
std::vector<Pose2d> parkingPoses(const ParkingSpace& space, const VehicleParams& vehicle, double margin,
                                 ParkingDirection direction);

/// The space together with what the vehicle `parked` in it needs: spaces of real maps are drawn roughly. Neighbouring
/// spaces still count as obstacles.
Polygon placeFor(const ParkingSpace& space, const VehicleParams& vehicle, double margin, const Pose2d& parked);

/// Where a vehicle may manoeuvre between `core` (a parking space or an area) and the lanes around it: both surfaces,
/// the gap between them closed as far as needed for `on_lane` to be inside; the other parking spaces are obstacles.
Region::Parts surfaceWith(const HdMap& map, const Polygon& core, const Pose2d& on_lane);

/// Replaces the end of the plan's path by the cheapest way into one of `goals` from a place on it.
/// @throws GoalBlocked, NoPath, PlanningTimeout, Cancelled
void leaveRouteFor(const std::vector<Pose2d>& goals, const Region& region, const ManoeuvrePlanner& planner,
                   const CancelToken& cancel, MotionPlan* plan);

/// Where the vehicle stands off the lanes, in a parking space, an area or elsewhere, the path begins with a manoeuvre
/// from there onto the route; where none is found the path begins on the lane, with a warning that tells the distance.
/// @throws Cancelled
/// @throws NoPath  it would begin farther away than `routing/max_path_start_distance`.
void leaveParkingPlace(const ProcessContext& context, const Pose2d& vehicle, const ManoeuvrePlanner& planner,
                       const CancelToken& cancel, MotionPlan* plan);

}  // namespace external_command
