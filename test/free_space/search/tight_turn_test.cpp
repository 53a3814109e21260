// SPDX-License-Identifier: Apache-2.0
#include "free_space/search/tight_turn.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/error.h"
#include "external_command/free_space/free_space_planner.h"
#include "support/parking_worlds.h"

namespace external_command {
namespace {

const auto kNeverStop = [] { return false; };

BoundingBox areaAround(const ParkingWorld& world) {
  constexpr double kRoom = 20.0;  // [m]
  const Point2d room = Point2d::Constant(kRoom);
  return {world.start.position().cwiseMin(world.goal.position()) - room,
          world.start.position().cwiseMax(world.goal.position()) + room};
}

std::optional<TightTurn> tightTurnIn(const ParkingWorld& world, const std::function<bool()>& stop = kNeverStop) {
  const FootprintIndex index(world.vehicle, 0.0, world.region, {0.0, 0.0}, {world.start, world.goal}, [] {});
  return tightTurn(index, areaAround(world), world.start, world.goal, stop);
}

/// Between two walls of 100 m; to turn round, there is their distance.
ParkingWorld street(double width) {
  Region::Parts parts;
  for (const double side : {-1.0, 1.0})
    parts.non_drivable.push_back(box({0.0, side * (width + 1.0) / 2.0}, 100.0, 1.0));
  return {smallCar(), {-10.0, 0.0, 0.0}, {10.0, 0.0, M_PI}, Region(parts)};
}

/// From the left into a corridor that leads up; both are as wide.
ParkingWorld corner(double width) {
  Region::Parts parts;
  parts.drivable = Polygon({{-40.0, 0.0}, {width, 0.0}, {width, 40.0}, {0.0, 40.0}, {0.0, width}, {-40.0, width}}, "");
  return {smallCar(), {-15.0, width / 2.0, 0.0}, {width / 2.0, 15.0, M_PI_2}, Region(parts)};
}

TEST(TightTurn, IsProvedInAStreetThatIsNarrowerThanTheVehicleIsLong) {
  const auto turn = tightTurnIn(street(smallCar().length() - 0.6));
  ASSERT_TRUE(turn && turn->heading_off);
  EXPECT_GT(*turn->heading_off, M_PI_2);
  EXPECT_LE(*turn->heading_off, M_PI);
}

TEST(TightTurn, IsNotProvedWhereTheVehicleCouldTurnOnTheSpot) {
  const VehicleParams car = smallCar();
  EXPECT_FALSE(tightTurnIn(street(std::hypot(car.length(), car.width) + 0.01)));
}

TEST(TightTurn, IsProvedInABendThatIsTooTight) {
  const auto turn = tightTurnIn(corner(smallCar().width + 0.2));
  ASSERT_TRUE(turn);
  EXPECT_FALSE(turn->heading_off);
}

TEST(TightTurn, IsNotProvedInABendWithRoomEnough) { EXPECT_FALSE(tightTurnIn(corner(smallCar().length()))); }

TEST(TightTurn, IsNotProvedForTheHeadingTheVehicleHas) {
  ParkingWorld world = street(3.0);
  world.goal.heading = 0.0;
  EXPECT_FALSE(tightTurnIn(world));
}

TEST(TightTurn, IsNotProvedOnceStopped) {
  EXPECT_FALSE(tightTurnIn(street(4.0), [] { return true; }));
}

TEST(TightTurn, IsNeverProvedWhereThereIsAPath) {
  FreeSpaceParams params;
  params.margin = 0.0;
  params.planner = "hybrid_astar";
  params.max_iterations = 4000;
  int solved = 0;
  for (const ParkingWorld& world : randomWorlds(5, 60)) {
    try {
      FreeSpacePlanner(world.vehicle, params).plan(world.start, {world.goal}, world.region, CancelToken());
    } catch (const Error&) {
      continue;
    }
    ++solved;
    EXPECT_FALSE(tightTurnIn(world)) << "world " << solved;
  }
  EXPECT_GT(solved, 30);
}

}  // namespace
}  // namespace external_command
