// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/path.h"
#include "external_command/core/vehicle.h"
#include "external_command/free_space/free_space_params.h"
#include "external_command/motion/region.h"

namespace external_command {

struct FreeSpacePlan {
  Path path;                    ///< of the rear-axle centre, from start to goal; speeds are caps, see limitSpeeds()
  double cost = 0.0;            ///< see FreeSpaceParams [m]
  double length = 0.0;          ///< driven, in both gears [m]
  double reverse_length = 0.0;  ///< of it in reverse [m]
  unsigned gear_changes = 0;
  double wheel_turns = 0.0;        ///< between gear changes; 1 from straight on to full lock
  double near_length = 0.0;        ///< beside obstacles: a metre at the margin counts whole, farther away less [m]
  double min_clearance = 0.0;      ///< of the bare footprint to obstacles and borders, at most 10 m [m]
  double planning_time = 0.0;      ///< wall clock [s]
  double first_path_time = 0.0;    ///< until the first valid path was there [s]
  double first_path_cost = 0.0;    ///< its cost [m]
  double first_path_length = 0.0;  ///< driven, in both gears [m]
  unsigned first_path_gear_changes = 0;
  std::string planner;                ///< FreeSpaceParams::planner
  std::size_t goal_index = 0;         ///< which of the goals it reaches
  bool begins_before = false;         ///< the path begins at EndState::bend_from, not at the start
  bool ends_beyond = false;           ///< it ends at EndState::bend_from, not at the goal
  std::vector<std::string> warnings;  ///< the start or that goal is nearer to an obstacle than the margin
};

/// How the vehicle drives where another path leads up to an end of the planned one, or on from it.
struct EndState {
  Direction direction = Direction::kForward;
  double kappa = 0.0;  ///< of the other path there [1/m]
  /// A pose on the other path up to which it may be bent so that steering is gradual: what lies between that and the
  /// end becomes part of the planned path. Of nearly the same curvature.
  Pose2d bend_from = {};
  double bend_length = 0.0;  ///< from there to the end [m]; 0: the other path stays as it is
};

struct EndStates {
  std::optional<EndState> start = std::nullopt;  ///< unset: the vehicle stands there
  /// One for each goal, unset where the vehicle stops there; empty: it stops at each.
  std::vector<std::optional<EndState>> goals = {};
};

/// Plans a path for a car-like vehicle from pose to pose inside a region. Thread-safe: const, no shared state.
class FreeSpacePlanner {
 public:
  /// @throws InvalidParameter  a value of `vehicle` or `params` is out of range.
  FreeSpacePlanner(const VehicleParams& vehicle, const FreeSpaceParams& params);

  /// The cheapest path found that begins at `start` and ends at one of `goals` (nose in or backing in, for example),
  /// within 1 mm and 0.01 degrees; checked once more, finely and exactly, before it is returned. Its points are at most
  /// `spacing` apart, and between two neighbours curvature and gear are constant up to the rounding of the spacing.
  /// A start or goal that is nearer to an obstacle than the margin is left or reached with a smaller margin nearby.
  /// @param ends  what leads up to the start, and on from the goals: a gear change there is paid for; without one,
  ///              steering is gradual there too, where there is room.
  /// @param checked  called once start and goals are found free, before the search.
  /// @throws InvalidRequest   a number is not finite, there is no goal, start and goals lie over 10 km apart, or `ends`
  ///                          names some of the goals only.
  /// @throws StartBlocked     the bare footprint collides at the start; the text says with what and by how much.
  /// @throws GoalBlocked      it does at every goal.
  /// @throws NoPath           a gap or a bend is too tight for the vehicle, the search has shown that there is no path
  ///                          at its finest resolution, or it used its iterations; the text says which.
  /// @throws PlanningTimeout  time_budget ran out first.
  /// @throws Cancelled        `cancel` was raised; noticed within a few milliseconds.
  FreeSpacePlan plan(const Pose2d& start, const std::vector<Pose2d>& goals, const Region& region,
                     const CancelToken& cancel, const EndStates& ends = {}, const std::function<void()>& checked = {}) const;

 private:
  VehicleParams vehicle_;
  FreeSpaceParams params_;
};

}  // namespace external_command
