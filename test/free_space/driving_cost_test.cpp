// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "quick_plans.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

FreeSpaceParams reversingAt(double reverse_factor) {
  FreeSpaceParams params = quickParams();
  params.reverse_factor = reverse_factor;
  return params;
}

/// A free plain; the goal lies behind the vehicle, which has room to turn round.
FreeSpacePlan plannedBackwards(double distance, double reverse_factor) {
  return FreeSpacePlanner(smallCar(), reversingAt(reverse_factor))
      .plan({0.0, 0.0, 0.0}, {{-distance, 3.0, 0.0}}, Region(), {});
}

TEST(DrivingCost, LetsTheVehicleTurnRoundForALongWay) {
  const double defaults = FreeSpaceParams().reverse_factor;
  for (const double distance : {60.0, 500.0}) {
    const FreeSpacePlan result = plannedBackwards(distance, defaults);
    EXPECT_LT(result.reverse_length, 0.15 * result.length) << distance;
    EXPECT_GT(plannedBackwards(distance, 1.0).reverse_length, 0.85 * distance) << distance;
  }
}

TEST(DrivingCost, LetsTheVehicleReverseAShortWay) {
  EXPECT_GT(plannedBackwards(8.0, FreeSpaceParams().reverse_factor).reverse_length, 7.0);
}

/// Mean distance of the footprint's sides from the wall that the vehicle begins beside, over the middle of its way [m].
double wayOffTheWall(double closeness_cost) {
  const VehicleParams vehicle = smallCar();
  Region::Parts parts;
  parts.non_drivable.push_back(box({20.0, -0.5}, 80.0, 1.0));
  const double beside = vehicle.width / 2.0 + 0.25;  // nearer, it cannot turn away: the rear swings out
  FreeSpaceParams params = reversingAt(2.0);
  params.closeness_cost = closeness_cost;
  const FreeSpacePlan result =
      FreeSpacePlanner(vehicle, params).plan({0.0, beside, 0.0}, {{40.0, beside, 0.0}}, Region(std::move(parts)), {});
  double sum = 0.0;
  int count = 0;
  for (const ReferencePoint& point : result.path) {
    if (point.x < 10.0 || point.x > 30.0) continue;
    sum += point.y - vehicle.width / 2.0;
    ++count;
  }
  return sum / count;
}

TEST(DrivingCost, KeepsAwayFromAWallWhereThereIsRoom) { EXPECT_GT(wayOffTheWall(0.3), 0.4); }

TEST(DrivingCost, FollowsTheWallWhereClosenessCostsNothing) { EXPECT_LT(wayOffTheWall(0.0), 0.26); }

double wheelTurns(double steering_cost) {
  FreeSpaceParams params = reversingAt(2.0);
  params.steering_cost = steering_cost;
  double sum = 0.0;
  for (const ParkingWorld& world : {parallelSlot(1.5), parallelSlot(0.7), bay(0.4), twoYards(1.0)}) {
    sum += FreeSpacePlanner(world.vehicle, params).plan(world.start, {world.goal}, world.region, {}).wheel_turns;
  }
  return sum;
}

TEST(DrivingCost, TurnsTheWheelsLessWhereThatHasAPrice) { EXPECT_LT(wheelTurns(0.2), 0.8 * wheelTurns(0.0)); }

TEST(DrivingCost, IsToldWithEachPath) {
  for (const double reverse_factor : {1.0, 2.0, 5.0}) {
    const ParkingWorld world = bay(1.0);
    const FreeSpacePlan result = planned(world, reversingAt(reverse_factor));
    const double driving = result.length + (reverse_factor - 1.0) * result.reverse_length;
    const FreeSpaceParams params;
    const double steering = params.steering_cost * result.wheel_turns;
    const double closeness = params.closeness_cost * result.near_length;
    EXPECT_NEAR(result.cost, driving + 3.0 * result.gear_changes + steering + closeness, 1e-6) << reverse_factor;
    EXPECT_TRUE(isDrivable(result.path, world.vehicle));
  }
}

}  // namespace
}  // namespace external_command
