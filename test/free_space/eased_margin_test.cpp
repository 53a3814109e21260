// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "external_command/core/error.h"
#include "external_command/motion/collision_checker.h"
#include "quick_plans.h"
#include "support/path_matchers.h"
#include "support/reference_clearance.h"

namespace external_command {
namespace {

FreeSpaceParams defaultMargin() { return quickParams(FreeSpaceParams().margin); }

/// Whether the path comes nearer than the margin only within `reach` [m] of `place`.
testing::AssertionResult keepsTheMarginAwayFrom(const Pose2d& place, double reach, const FreeSpacePlan& result,
                                                const ParkingWorld& world) {
  Path away;
  for (const ReferencePoint& point : result.path) {
    if (std::hypot(point.x - place.x, point.y - place.y) > reach) away.push_back(point);
  }
  return staysClear(away, world.vehicle, world.region, defaultMargin().margin - kMarginSlack);
}

TEST(EasedMargin, LetsAPathEndBetweenCarsNearerThanTheMargin) {
  const ParkingWorld world = bay(0.12);
  const FreeSpacePlan result = planned(world, defaultMargin());
  EXPECT_TRUE(joins(result.path, world.start, world.goal));
  EXPECT_TRUE(isDrivable(result.path, world.vehicle));
  EXPECT_TRUE(staysClear(result.path, world.vehicle, world.region, 0.03 - kMarginSlack));
  EXPECT_TRUE(keepsTheMarginAwayFrom(world.goal, 2.0 * world.vehicle.length(), result, world));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("the goal ("), std::string::npos) << result.warnings[0];
  EXPECT_NE(result.warnings[0].find("is 0.06 m from box,"), std::string::npos) << result.warnings[0];
}

TEST(EasedMargin, LetsAPathBeginBetweenThem) {
  ParkingWorld world = bay(0.12);
  std::swap(world.start, world.goal);
  const FreeSpacePlan result = planned(world, defaultMargin());
  EXPECT_TRUE(joins(result.path, world.start, world.goal));
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("the start ("), std::string::npos) << result.warnings[0];
}

TEST(EasedMargin, IsNotToldWhereThereIsRoom) { EXPECT_TRUE(planned(bay(0.6), defaultMargin()).warnings.empty()); }

TEST(EasedMargin, RefusesOnlyWhatTheBareFootprintMeets) {
  EXPECT_NO_THROW(planned(bay(0.02), defaultMargin()));
  EXPECT_THROW(planned(bay(-0.02), defaultMargin()), GoalBlocked);
  ParkingWorld world = bay(-0.02);
  std::swap(world.start, world.goal);
  EXPECT_THROW(planned(world, defaultMargin()), StartBlocked);
}

/// Two walls, `gap` [m] wider apart than the vehicle.
ParkingWorld corridor(double gap) {
  ParkingWorld world{smallCar(), {0, 0, 0}, {25, 0, 0}, Region()};
  const double beside = 0.5 * (world.vehicle.width + gap) + 0.5;
  Region::Parts parts;
  for (const double y : {beside, -beside}) parts.non_drivable.push_back(box({12.0, y}, 80.0, 1.0));
  world.region = Region(std::move(parts));
  return world;
}

TEST(EasedMargin, LeavesACorridorThatIsTooNarrowAllAlongToBeNamed) {
  const double margin = defaultMargin().margin;
  try {
    planned(corridor(2.0 * margin - 0.04), defaultMargin());
    FAIL() << "a path was found";
  } catch (const NoPath& error) {
    const std::string refusal = error.what();
    EXPECT_NE(refusal.find("the widest way is only"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("the margins to both sides included"), std::string::npos) << refusal;
  }
  EXPECT_NO_THROW(planned(corridor(2.0 * margin + 0.04), defaultMargin()));
}

TEST(EasedMargin, HoldsForTheNearObstacleAndNoOther) {
  Region::Parts parts;
  const VehicleParams vehicle = smallCar();
  const double beside = vehicle.width / 2.0;
  parts.non_drivable.push_back(box({0.0, beside + 0.04 + 0.5}, 100.0, 1.0));  // 4 cm to the left
  parts.non_drivable.push_back(box({8.0, -beside - 0.3 - 0.5}, 4.0, 1.0));    // 30 cm to the right, ahead
  const Pose2d place{0.0, 0.0, 0.0};
  const CollisionChecker checker(vehicle, 0.1, Region(parts), [] {}, {place});
  EXPECT_TRUE(checker.isFree(place));
  EXPECT_TRUE(checker.isFree({1.0, 0.015, 0.0}));
  EXPECT_FALSE(checker.isFree({1.0, 0.03, 0.0}));
  EXPECT_FALSE(checker.isFree({20.0, 0.0, 0.0}));
  EXPECT_TRUE(checker.isFree({20.0, -0.07, 0.0}));
  EXPECT_FALSE(checker.isFree({7.0, -0.25, 0.0}));
  EXPECT_FALSE(CollisionChecker(vehicle, 0.1, Region(parts)).isFree(place));
}

}  // namespace
}  // namespace external_command
