// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "external_command/motion/reeds_shepp.h"
#include "quick_plans.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

FreeSpaceParams paramsWith(bool continuous_curvature) {
  FreeSpaceParams params = quickParams();
  params.continuous_curvature = continuous_curvature;
  return params;
}

/// The fastest that the front wheels have to turn while the vehicle drives as fast as the points allow [rad/s].
double fastestSteering(const Path& path, const VehicleParams& vehicle) {
  double fastest = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].direction != path[i - 1].direction) continue;
    const double turned =
        std::atan(vehicle.wheelbase * path[i].kappa) - std::atan(vehicle.wheelbase * path[i - 1].kappa);
    const double speed = std::min(path[i].speed, path[i - 1].speed);
    fastest = std::max(fastest, std::abs(turned) * speed / (path[i].s - path[i - 1].s));
  }
  return fastest;
}

double largestJump(const Path& path) {
  double largest = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].direction == path[i - 1].direction)
      largest = std::max(largest, std::abs(path[i].kappa - path[i - 1].kappa));
  }
  return largest;
}

TEST(ContinuousCurvature, SteersGraduallyWhereThatIsWished) {
  const FreeSpaceParams params = paramsWith(true);
  for (const ParkingWorld& world : {parallelSlot(1.5), parallelSlot(0.7), bay(0.4), twoYards(1.0)}) {
    const FreeSpacePlan result = planned(world, params);
    EXPECT_TRUE(joins(result.path, world.start, world.goal));
    EXPECT_TRUE(isDrivable(result.path, world.vehicle, {params.spacing}));
    EXPECT_TRUE(staysClear(result.path, world.vehicle, world.region, params.margin - kMarginSlack));
    EXPECT_LT(fastestSteering(result.path, world.vehicle), 1.02 * world.vehicle.max_steering_rate);
    EXPECT_LT(largestJump(result.path), 0.6 * largestJump(planned(world, paramsWith(false)).path));
  }
}

TEST(ContinuousCurvature, SteersGraduallyThoughTheImprovementMayTakeAllTheTime) {
  FreeSpaceParams params = paramsWith(true);
  params.time_budget = params.improve_budget = 1.0;
  params.improve_iterations = 0;
  for (const ParkingWorld& world : {parallelSlot(1.5), bay(0.4)}) {
    const FreeSpacePlan result = planned(world, params);
    EXPECT_LT(result.cost, result.first_path_cost + 1e-9);
    EXPECT_LT(largestJump(result.path), 0.6 * largestJump(planned(world, paramsWith(false)).path));
  }
}

TEST(ContinuousCurvature, SteersGraduallyAtTheManoeuvreSpeedWhereThereIsRoom) {
  ParkingWorld world = parallelSlot(1.5);
  world.region = Region();
  world.goal = {world.start.x + 20.0, world.start.y + 6.0, world.start.heading + 0.7};
  const FreeSpaceParams params = paramsWith(true);
  const Path path = planned(world, params).path;
  EXPECT_TRUE(joins(path, world.start, world.goal));
  const double ramp = 0.05 * world.vehicle.max_steering_rate / (params.manoeuvre_speed * world.vehicle.wheelbase);
  EXPECT_LT(largestJump(path), 1.5 * ramp);
}

const Pose2d kAhead{20.0, 6.0, 0.7};
constexpr double kBend = 1.5;  // [m]

/// That may be bent for kBend, a straight path or one of a curvature.
EndState pathBefore(double kappa, Direction direction = Direction::kForward) {
  const double length = direction == Direction::kForward ? -kBend : kBend;
  return {direction, kappa, advance(Pose2d{}, ArcSegment{length, kappa}), kBend};
}

EndState pathAfter(double kappa) {
  return {Direction::kForward, kappa, advance(kAhead, ArcSegment{kBend, kappa}), kBend};
}

FreeSpacePlan plannedAhead(const EndStates& ends) {
  return FreeSpacePlanner(smallCar(), paramsWith(true)).plan({}, {kAhead}, Region(), {}, ends);
}

/// Largest change of curvature from one point to the next, the paths before and after it included.
double largestJumpWith(const EndStates& ends, const Path& path) {
  const double before = std::abs(path[1].kappa - ends.start->kappa);
  const double after = std::abs(path.back().kappa - ends.goals[0]->kappa);
  return std::max({largestJump(path), before, after});
}

TEST(ContinuousCurvature, GoesOnFromAPathAndIntoAnotherWithoutAJump) {
  const double ramp = 0.1 * smallCar().max_steering_rate / smallCar().wheelbase;
  for (const double kappa : {0.0, 0.1, -0.1}) {
    const EndStates ends{pathBefore(kappa), {pathAfter(-kappa)}};
    const FreeSpacePlan plan = plannedAhead(ends);
    ASSERT_TRUE(plan.begins_before && plan.ends_beyond);
    EXPECT_TRUE(joins(plan.path, ends.start->bend_from, ends.goals[0]->bend_from));
    EXPECT_TRUE(isDrivable(plan.path, smallCar(), {paramsWith(true).spacing}));
    EXPECT_LT(largestJumpWith(ends, plan.path), 2.0 * ramp);
  }
}

TEST(ContinuousCurvature, MeetsPathsThatAreNoArcsExactly) {
  EndStates ends{pathBefore(0.02), {pathAfter(0.0)}};
  ends.start->bend_from = compose(ends.start->bend_from, {0.01, 0.01, 0.02});
  ends.goals[0]->bend_from = compose(ends.goals[0]->bend_from, {0.0, -0.01, 0.01});
  const FreeSpacePlan plan = plannedAhead(ends);
  ASSERT_TRUE(plan.begins_before && plan.ends_beyond);
  EXPECT_TRUE(joins(plan.path, ends.start->bend_from, ends.goals[0]->bend_from));
}

TEST(ContinuousCurvature, LeavesAPathAsItIsThatMayNotBeBent) {
  const FreeSpacePlan plan = plannedAhead({EndState{}, {EndState{}}});
  EXPECT_FALSE(plan.begins_before || plan.ends_beyond);
  EXPECT_TRUE(joins(plan.path, {}, kAhead));
}

TEST(ContinuousCurvature, LeavesAPathAsItIsWhereThatCannotBeBent) {
  EndState elsewhere = pathBefore(0.0);
  elsewhere.bend_from.y += 50.0;
  const FreeSpacePlan plan = plannedAhead({elsewhere, {}});
  EXPECT_FALSE(plan.begins_before);
  EXPECT_TRUE(joins(plan.path, {}, kAhead));
}

TEST(ContinuousCurvature, MayBeginAndEndAtFullLockWhereTheVehicleStands) {
  const Path path = plannedAhead({}).path;
  EXPECT_GT(std::abs(path[1].kappa), 0.9 * smallCar().maxKappa());
}

TEST(ContinuousCurvature, TurnsTheWheelsAtRestWhereTheGearChangesAtAnEnd) {
  const FreeSpacePlan plan = plannedAhead({pathBefore(0.0, Direction::kReverse), {}});
  EXPECT_FALSE(plan.begins_before);
  EXPECT_EQ(plan.path[1].direction, Direction::kForward);
  EXPECT_GT(std::abs(plan.path[1].kappa), 0.9 * smallCar().maxKappa());
}

}  // namespace
}  // namespace external_command
