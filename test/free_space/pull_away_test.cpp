// SPDX-License-Identifier: Apache-2.0
#include "free_space/pull_away.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/error.h"
#include "quick_plans.h"
#include "search/search_world.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

constexpr double kMargin = 0.1;

/// A wall of 60 m to the left of the start, `distance` [m] from it; the goal lies 20 m ahead, 4 m from the wall.
///
///   ==================== wall
///    S ->
///                    G
ParkingWorld besideAWall(double distance, std::vector<Polygon> others = {}) {
  ParkingWorld world{smallCar(), {0.0, 0.0, 0.0}, {20.0, -4.0, 0.0}, Region()};
  Region::Parts parts;
  parts.non_drivable = std::move(others);
  parts.non_drivable.push_back(box({10.0, 0.5 * world.vehicle.width + distance + 0.5}, 60.0, 1.0));
  world.region = Region(std::move(parts));
  return world;
}

/// From the goal to the start.
ParkingWorld back(ParkingWorld world) {
  std::swap(world.start, world.goal);
  return world;
}

/// 3 cm before nose and behind tail.
std::vector<Polygon> carsAroundTheStart() {
  const VehicleParams car = smallCar();
  const double middle = 0.5 * car.length() - car.rear_overhang, apart = car.length() + 0.03;
  return {box({middle - apart, 0.0}, car.length(), car.width), box({middle + apart, 0.0}, car.length(), car.width)};
}

/// Whether all of the arcs are driven in one gear, to one side, each tighter than the one before it.
testing::AssertionResult drawsAway(const Arcs& arcs) {
  for (std::size_t i = 1; i < arcs.size(); ++i) {
    if (gearOf(arcs[i]) != gearOf(arcs[0])) return testing::AssertionFailure() << "arc " << i << " changes gear";
    if (arcs[i].kappa * arcs[i - 1].kappa <= 0.0) return testing::AssertionFailure() << "arc " << i << " changes side";
    if (std::abs(arcs[i].kappa) <= std::abs(arcs[i - 1].kappa)) {
      return testing::AssertionFailure() << "arc " << i << " is no tighter than the one before it";
    }
  }
  return testing::AssertionSuccess();
}

TEST(PullAway, DrawsAwayUntilFullLockCanBeDriven) {
  for (const double distance : {0.001, 0.01, 0.05}) {
    const SearchWorld world(besideAWall(distance), kMargin);
    const std::vector<Arcs> ways = pullAways(world.scene, world.query.start);
    ASSERT_FALSE(ways.empty()) << distance;
    for (const Arcs& way : ways) {
      EXPECT_TRUE(drawsAway(way)) << distance;
      Pose2d pose = world.query.start;
      for (const ArcSegment& arc : way) {
        EXPECT_TRUE(world.index.keepsMargin(pose, arc)) << distance;
        pose = advance(pose, arc);
      }
      const double full_lock = std::copysign(1.0 / world.scene.radius, way.back().kappa);
      EXPECT_TRUE(world.index.keepsMargin(pose, {gearOf(way.back()) * 0.5, full_lock})) << distance;
    }
  }
}

TEST(PullAway, IsNotNeededWhereFullLockCanBeDriven) {
  const SearchWorld world(besideAWall(0.3), kMargin);
  EXPECT_TRUE(pullAways(world.scene, world.query.start).empty());
}

TEST(PullAway, IsNotFoundBetweenOtherCars) {
  const SearchWorld world(besideAWall(0.01, carsAroundTheStart()), kMargin);
  EXPECT_TRUE(pullAways(world.scene, world.query.start).empty());
}

TEST(PullAway, LetsAPathBeginAndEndCloseBesideALongWall) {
  const FreeSpaceParams params = quickParams(kMargin);
  for (const double distance : {0.001, 0.005, 0.01, 0.03}) {
    for (const ParkingWorld& world : {besideAWall(distance), back(besideAWall(distance))}) {
      const FreeSpacePlan result = planned(world, params);
      EXPECT_TRUE(joins(result.path, world.start, world.goal)) << distance;
      EXPECT_TRUE(isDrivable(result.path, world.vehicle)) << distance;
      EXPECT_TRUE(staysClear(result.path, world.vehicle, world.region, 0.4 * distance)) << distance;
      ASSERT_EQ(result.warnings.size(), 1u) << distance;
      EXPECT_NE(result.warnings[0].find("nearer than the margin"), std::string::npos) << result.warnings[0];
      const Pose2d& near = world.start.y == 0.0 ? world.start : world.goal;
      Path away;
      for (const ReferencePoint& point : result.path) {
        if (std::hypot(point.x - near.x, point.y - near.y) > 3.0 * world.vehicle.length()) away.push_back(point);
      }
      EXPECT_TRUE(staysClear(away, world.vehicle, world.region, kMargin - kMarginSlack)) << distance;
    }
  }
}

TEST(PullAway, LetsAPathLeadAlongAWallThatBothEndsAreCloseTo) {
  ParkingWorld world = besideAWall(0.01);
  world.goal = {15.0, 0.0, 0.0};
  const FreeSpacePlan result = planned(world, quickParams(kMargin));
  EXPECT_TRUE(joins(result.path, world.start, world.goal));
  EXPECT_TRUE(staysClear(result.path, world.vehicle, world.region, 0.004));
  EXPECT_EQ(result.warnings.size(), 2u);
}

TEST(PullAway, IsCheaperThanFullLockAloneWhereThatHardlySuffices) {
  const ParkingWorld world = besideAWall(0.02);
  const SearchWorld search(world, kMargin);
  const FirstPathRequest request{"portfolio", 100'000, 1};
  const StopCondition stop(CancelToken(), Clock::time_point::max());
  const FirstPath alone = findFirstPath(search.scene, search.query, search.area, request, stop);
  const std::vector<FirstPath> paths = findFirstPaths(search.scene, search.query, search.area, request, stop);
  ASSERT_EQ(alone.outcome, TwoWaySearch::Outcome::kFound);
  ASSERT_EQ(paths.back().outcome, TwoWaySearch::Outcome::kFound);
  EXPECT_LT(costOf(paths.back().arcs, search.scene.cost), costOf(alone.arcs, search.scene.cost));
}

TEST(PullAway, IsRefusedWithWhatIsNearAndHowNear) {
  try {
    planned(besideAWall(0.001, carsAroundTheStart()), quickParams(kMargin));
    FAIL() << "a path was found";
  } catch (const NoPath& error) {
    const std::string refusal = error.what();
    EXPECT_NE(refusal.find("the start (0.00, 0.00, 0.000) is 1 mm from box, nearer than the margin of 0.10 m"),
              std::string::npos)
        << refusal;
    EXPECT_NE(refusal.find("choose a pose farther away, or a smaller margin (margin)"), std::string::npos) << refusal;
  }
}

}  // namespace
}  // namespace external_command
