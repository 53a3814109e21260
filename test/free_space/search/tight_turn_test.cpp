// SPDX-License-Identifier: Apache-2.0
#include "free_space/search/tight_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/free_space/free_space_planner.h"
#include "free_space/search/no_way.h"
#include "search_world.h"

namespace external_command {
namespace {

std::optional<TightTurn> tightTurnIn(const ParkingWorld& place, const std::function<bool()>& stop = kNeverStop) {
  const SearchWorld world(place);
  return tightTurn(world.index, world.area, place.start, place.goal, {world.to_start, world.to_goal}, stop);
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

/// What fits round a bend of two corridors as wide as that, standing across its corner, is 2 * sqrt(2) widths long,
/// less twice its own width.
TEST(TightTurn, IsProvedInABendThatTheVehicleIsAThirdOfAMetreTooLongFor) {
  const VehicleParams car = smallCar();
  const double fitting = (car.length() + 2.0 * car.width) / (2.0 * M_SQRT2);
  EXPECT_TRUE(tightTurnIn(corner(fitting - 0.35 / (2.0 * M_SQRT2))));
  EXPECT_FALSE(tightTurnIn(corner(fitting + 0.02)));
}

TEST(TightTurn, IsNotProvedInABendWithRoomEnough) { EXPECT_FALSE(tightTurnIn(corner(smallCar().length()))); }

TEST(TightTurn, IsNotProvedForTheHeadingTheVehicleHas) {
  ParkingWorld world = street(3.0);
  world.goal.heading = 0.0;
  EXPECT_FALSE(tightTurnIn(world));
}

/// A bay narrower than the vehicle, at a yard in which there are millions of poses.
ParkingWorld yardWithANarrowBay(double side) {
  ParkingWorld world = bay(-0.15);
  Region::Parts parts;
  parts.non_drivable = world.region.nonDrivable();
  parts.non_drivable.pop_back();  // the wall across the aisle
  parts.drivable = box({0.0, 0.5 * side}, side, side + 1.0);
  world.region = Region(std::move(parts));
  return world;
}

TEST(TightTurn, IsProvedAtTheTightEndBesideAWideYard) {
  for (const double side : {30.0, 60.0}) {
    int looks = 0;
    const auto count = [&looks] { return ++looks > 1000; };
    EXPECT_TRUE(tightTurnIn(yardWithANarrowBay(side), count)) << side;
    ParkingWorld back = yardWithANarrowBay(side);
    std::swap(back.start, back.goal);
    EXPECT_TRUE(tightTurnIn(back, count)) << side;
    EXPECT_LT(looks, 100) << side;
  }
}

TEST(TightTurn, IsNotProvedOnceStopped) {
  EXPECT_FALSE(tightTurnIn(street(4.0), [] { return true; }));
}

/// Beside the start and 3 cm from it.
ParkingWorld withAKerbAtTheStart(ParkingWorld world) {
  const double beside = 0.5 * world.vehicle.width + 0.03 + 0.1;
  const Pose2d kerb = compose(world.start, {0.0, -beside, 0.0});
  Region::Parts parts;
  parts.non_drivable = world.region.nonDrivable();
  parts.drivable = world.region.drivable();
  parts.non_drivable.push_back(box(kerb.position(), 2.0, 0.2, kerb.heading));
  world.region = Region(std::move(parts));
  return world;
}

TEST(NoWay, IsProvedWhereOnlyTheMarginAtTheStartIsEased) {
  const double margin = 0.1;
  const auto isProved = [&](double gap) {
    const ParkingWorld place = withAKerbAtTheStart(twoYards(gap));
    const SearchWorld world(place, margin);
    EXPECT_EQ(world.index.easedMargins().size(), 1u);
    return proveNoWay(world.index, world.area, place.start, place.goal, {world.to_start, world.to_goal}, kNeverStop)
        .has_value();
  };
  EXPECT_TRUE(isProved(2.0 * margin - 0.02));
  EXPECT_FALSE(isProved(2.0 * margin + 0.02));
}

/// Tried with few steps.
bool hasAPath(const ParkingWorld& place, double margin) {
  FreeSpaceParams params;
  params.margin = margin;
  params.planner = "hybrid_astar";
  params.max_iterations = 4000;
  try {
    FreeSpacePlanner(place.vehicle, params).plan(place.start, {place.goal}, place.region, CancelToken());
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST(NoWay, IsNeverProvedWhereAPathBeginsOrEndsNearerThanTheMargin) {
  const double margin = 0.3;
  int solved = 0;
  for (const ParkingWorld& place : randomWorlds(7, 80)) {
    const SearchWorld world(place, margin);
    if (world.index.easedMargins().empty() || !hasAPath(place, margin)) continue;
    ++solved;
    EXPECT_FALSE(
        proveNoWay(world.index, world.area, place.start, place.goal, {world.to_start, world.to_goal}, kNeverStop))
        << "world " << solved;
  }
  EXPECT_GT(solved, 10);
}

TEST(TightTurn, IsNeverProvedWhereThereIsAPath) {
  int solved = 0;
  for (const ParkingWorld& world : randomWorlds(5, 60)) {
    if (!hasAPath(world, 0.0)) continue;
    ++solved;
    EXPECT_FALSE(tightTurnIn(world)) << "world " << solved;
  }
  EXPECT_GT(solved, 30);
}

}  // namespace
}  // namespace external_command
