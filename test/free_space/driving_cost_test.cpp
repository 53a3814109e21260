// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "external_command/free_space/free_space_planner.h"
#include "support/parking_worlds.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

FreeSpaceParams paramsWith(double reverse_factor) {
  FreeSpaceParams params;
  params.margin = 0.05;
  params.time_budget = 600.0;  // the iterations bound the work
  params.improve_budget = 300.0;
  params.improve_iterations = 1000;
  params.reverse_factor = reverse_factor;
  return params;
}

/// A free plain; the goal lies behind the vehicle, which has room to turn round.
FreeSpacePlan plannedBackwards(double distance, double reverse_factor) {
  return FreeSpacePlanner(smallCar(), paramsWith(reverse_factor))
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

TEST(DrivingCost, IsToldWithEachPath) {
  for (const double reverse_factor : {1.0, 2.0, 5.0}) {
    const ParkingWorld world = bay(1.0);
    const FreeSpacePlan result =
        FreeSpacePlanner(world.vehicle, paramsWith(reverse_factor)).plan(world.start, {world.goal}, world.region, {});
    const double driving = result.length + (reverse_factor - 1.0) * result.reverse_length;
    EXPECT_NEAR(result.cost, driving + 3.0 * result.gear_changes, 1e-6) << reverse_factor;
    EXPECT_TRUE(isDrivable(result.path, world.vehicle));
  }
}

}  // namespace
}  // namespace external_command
