// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/reference_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "external_command/core/text.h"
#include "support/command_path_matcher.h"
#include "support/routing_world.h"

namespace external_command {
namespace {

class ReferencePathWorld : public RoutingWorld {
 protected:
  VehicleParams vehicle;
  ReferencePathParams path_params;

  /// A path of the map as it is, checked against the route.
  Path path(const Place& start, const Place& goal, double target_speed = 0.0) {
    const Route route = drive(start, goal);
    Path path = referencePath(map(), route, vehicle, path_params, {target_speed}).path;
    limitSpeeds(vehicle, &path);
    EXPECT_TRUE(isContinuous(path, 1.1 * path_params.spacing));
    const Lane &first = map().lane(laneIndex(map(), start.lane)), &last = map().lane(laneIndex(map(), goal.lane));
    EXPECT_LT((path.front().pose().position() - first.center.pointAt(start.s)).norm(), 1e-9);
    EXPECT_LT((path.back().pose().position() - last.center.pointAt(goal.s)).norm(), 1e-9);
    return path;
  }

  static double largestKappa(const Path& path) {
    double kappa = 0.0;
    for (const ReferencePoint& point : path) kappa = std::max(kappa, std::abs(point.kappa));
    return kappa;
  }

  static double highestSpeed(const Path& path) {
    double speed = 0.0;
    for (const ReferencePoint& point : path) speed = std::max(speed, point.speed);
    return speed;
  }

  /// Largest distance [m] of a point from the lane's centre line.
  double largestOffset(const Path& path, const std::string& lane) {
    double offset = 0.0;
    for (const ReferencePoint& point : path) {
      const Polyline& center = map().lane(laneIndex(map(), lane)).center;
      offset = std::max(offset, center.project(point.pose().position()).distance);
    }
    return offset;
  }
};

///   a -----> b -----> straight ahead, 200 m each
class StraightRoad : public ReferencePathWorld {
 protected:
  StraightRoad() { builder.lane("a", {0, 0}, {200, 0}).lane("b", {200, 0}, {400, 0}).follow({"a", "b"}); }
};

TEST_F(StraightRoad, IsSampledEvenly) {
  const Path straight = path({"a", 10}, {"b", 190});
  EXPECT_EQ(straight.size(), 761u);
  EXPECT_NEAR(straight.back().s, 380.0, 1e-6);
  for (std::size_t i = 1; i < straight.size(); ++i) EXPECT_NEAR(straight[i].s - straight[i - 1].s, 0.5, 1e-6);
  EXPECT_LT(largestKappa(straight), 1e-6);
}

TEST_F(StraightRoad, TakesTheSpeedOfTheLaneAndStopsAtTheEnd) {
  builder["b"].speed_limit = 5.0;
  const Path slower = path({"a", 0}, {"b", 200});
  EXPECT_NEAR(slower.front().speed, MapBuilder::kSpeedLimit, 1e-9);
  EXPECT_NEAR(slower[600].speed, 5.0, 1e-9);
  EXPECT_LT(slower[395].speed, 8.0) << "brakes ahead of the limit";
  EXPECT_EQ(slower.back().speed, 0.0);
}

TEST_F(StraightRoad, IsNoFasterThanAskedForOrThanTheVehicleIs) {
  EXPECT_NEAR(highestSpeed(path({"a", 0}, {"b", 200}, 3.0)), 3.0, 1e-9);
  EXPECT_NEAR(highestSpeed(path({"a", 0}, {"b", 200}, 50.0)), MapBuilder::kSpeedLimit, 1e-9);
  vehicle.max_speed = 2.0;
  EXPECT_NEAR(highestSpeed(path({"a", 0}, {"b", 200})), 2.0, 1e-9);
}

TEST_F(StraightRoad, TakesTheDefaultLimitWhereTheMapGivesNone) {
  builder["a"].speed_limit = builder["b"].speed_limit = 0.0;
  path_params.default_speed_limit = 7.0;
  EXPECT_NEAR(highestSpeed(path({"a", 0}, {"b", 200})), 7.0, 1e-9);
}

TEST_F(StraightRoad, HasTwoPointsAtLeast) {
  for (const double length : {0.0, 1e-4, 0.01, 0.4, 0.6, 1.1, 2.0}) {
    const Path shortest = path({"a", 10}, {"a", 10 + length});
    EXPECT_GE(shortest.size(), 2u);
    EXPECT_NEAR(shortest.back().s, length, 1e-3);
    EXPECT_NEAR(shortest.front().heading, 0.0, 1e-6);
  }
  EXPECT_EQ(path({"a", 0}, {"a", 0}).size(), 2u);
  EXPECT_EQ(path({"a", 200}, {"b", 0}).size(), 2u);
}

TEST_F(StraightRoad, TakesCoordinatesFarFromTheOrigin) {
  for (LaneData& lane : builder.data().lanes) {
    for (Point2d& point : lane.center) point += Point2d(5e5, 4.2e6);
  }
  EXPECT_LT(largestKappa(path({"a", 10}, {"b", 190})), 1e-5);
}

TEST_F(StraightRoad, TakesNoiseOutOfTheCentreLine) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (LaneData& lane : builder.data().lanes) {
    const double begin = lane.center.front().x();
    lane.center.clear();
    for (int i = 0; i <= 200; ++i) lane.center.emplace_back(begin + i, i % 200 == 0 ? 0.0 : noise(random));
  }
  const Path smooth = path({"a", 0}, {"b", 200});
  EXPECT_LT(largestKappa(smooth), 0.05);
  EXPECT_LT(largestOffset(Path(smooth.begin(), smooth.begin() + 390), "a"), 0.1);
}

TEST_F(StraightRoad, IsNotBentByPointsOfTheMapThatLieTooClose) {
  //   Files of the wild double points, and step back a hair where lanes meet.
  builder["a"].center = {{0, 0}, {100, 0}, {99.99, 0}, {100.02, 0.001}, {200, 0}};
  builder["b"].center = {{199.99, 0}, {199.995, 0.001}, {400, 0}};
  EXPECT_LT(largestKappa(path({"a", 0}, {"b", 200})), 0.01);
}

///   straight 50 m, a quarter circle of 20 m to the left, straight 50 m
class Bend : public ReferencePathWorld {
 protected:
  Bend() {
    builder.lane("in", {-50, 0}, {0, 0}).arc("bend", {0, 0, 0}, 20.0, M_PI / 2).lane("out", {20, 20}, {20, 70});
    builder.follow({"in", "bend", "out"});
  }
};

TEST_F(Bend, HasTheCurvatureOfTheLane) {
  const Path curved = path({"in", 0}, {"out", 50});
  EXPECT_NEAR(curved[131].kappa, 1.0 / 20.0, 0.003);
  EXPECT_LT(largestKappa(curved), 0.06);
  EXPECT_LT(largestOffset(Path(curved.begin() + 101, curved.begin() + 160), "bend"), 0.04);
  EXPECT_NEAR(curved[131].speed, std::sqrt(vehicle.max_lateral_acceleration * 20.0), 0.2);
  EXPECT_NEAR(curved.back().heading, M_PI / 2, 1e-3);
}

TEST_F(Bend, IsRoundWhereTheMapIsThinned) {
  std::vector<Point2d>& center = builder["bend"].center;
  std::vector<Point2d> thinned;
  for (std::size_t i = 0; i < center.size(); i += 4) thinned.push_back(center[i]);  // 0.2 rad from one to the next
  if (thinned.back() != center.back()) thinned.push_back(center.back());
  center = thinned;
  const Path curved = path({"in", 0}, {"out", 50});
  EXPECT_LT(largestKappa(curved), 0.08);
  EXPECT_LT(largestOffset(Path(curved.begin() + 100, curved.begin() + 160), "bend"), 0.08);
}

TEST_F(Bend, BeginsAndEndsInTheLanesDirection) {
  const Path within = path({"bend", 10}, {"bend", 20});
  EXPECT_NEAR(within.front().heading, 10.0 / 20.0, 0.01);
  EXPECT_NEAR(within.back().heading, 20.0 / 20.0, 0.01);
  EXPECT_NEAR(within.front().kappa, 1.0 / 20.0, 0.005);
}

///   left  --------> --------> 60 m pieces
///   right --------> -------->
class TwoLaneRoad : public ReferencePathWorld {
 protected:
  TwoLaneRoad() {
    builder.lane("l1", {0, MapBuilder::kLaneWidth}, {60, MapBuilder::kLaneWidth})
        .lane("l2", {60, MapBuilder::kLaneWidth}, {120, MapBuilder::kLaneWidth});
    builder.lane("r1", {0, 0}, {60, 0}).lane("r2", {60, 0}, {120, 0});
    builder.follow({"l1", "l2"}).follow({"r1", "r2"}).beside({"l1", "r1"}).beside({"l2", "r2"});
  }

  /// Where the path has left one lane, and reached the other [m].
  static std::pair<double, double> across(const Path& path) {
    double begin = 0.0, end = 0.0;
    for (const ReferencePoint& point : path) {
      if (std::abs(point.y) < 0.02) begin = point.s;
      if (std::abs(point.y) < MapBuilder::kLaneWidth - 0.02) end = point.s;
    }
    return {begin, end};
  }
};

TEST_F(TwoLaneRoad, ChangesLanesSmoothlyInTheLengthWished) {
  const Path change = path({"r1", 10}, {"l2", 50});
  const auto [begin, end] = across(change);
  EXPECT_LT(begin, 5.0) << "begins at once";
  EXPECT_NEAR(end, 30.0, 3.0);
  EXPECT_LT(largestKappa(change), 5.8 * MapBuilder::kLaneWidth / (30.0 * 30.0));
}

TEST_F(TwoLaneRoad, ChangesLanesInLessWhereThereIsLessRoom) {
  const Path change = path({"r1", 50}, {"l2", 5});
  EXPECT_NEAR(across(change).second, 15.0, 2.0);
  EXPECT_NEAR(change.back().heading, 0.0, 0.02);
  EXPECT_LT(largestKappa(change), 5.8 * MapBuilder::kLaneWidth / (15.0 * 15.0));
}

TEST_F(TwoLaneRoad, CanBeSteeredWhereAChangeHasNoMoreRoomThanTwoArcsNeed) {
  vehicle.min_turning_radius = params.min_turning_radius;
  const Path change = path({"r1", 50}, {"l1", 58.7});
  EXPECT_LT(largestKappa(change), 1.2 * vehicle.maxKappa());
  EXPECT_NEAR(change.front().heading, 0.0, 0.1);
  EXPECT_NEAR(change.back().heading, 0.0, 0.1);
}

TEST_F(TwoLaneRoad, GoesThereAndBackAroundABlock) {
  const Route route = drive({"r1", 0}, {}, {"r2", 60}, {{"r1", 50, 60}, {"r2", 0, 10}});
  Path detour = referencePath(map(), route, vehicle, path_params, {}).path;
  limitSpeeds(vehicle, &detour);
  EXPECT_TRUE(isContinuous(detour, 0.55));
  for (const ReferencePoint& point : detour) {
    if (point.x > 51.0 && point.x < 69.0) {
      EXPECT_NEAR(point.y, MapBuilder::kLaneWidth, 0.02);
    }
  }
}

/// What a driver expects of any path: it goes on without a jump, and turns within the vehicle's limit.
class CoarseJunction : public ReferencePathWorld {
 protected:
  ReferencePath along(const Place& start, const Place& goal) {
    const Route route = drive(start, goal);
    ReferencePath found = referencePath(map(), route, vehicle, path_params, {});
    limitSpeeds(vehicle, &found.path);
    if (found.tight.empty()) {
      EXPECT_TRUE(isDrivableCommandPath(found.path, vehicle));
    }
    return found;
  }

  void expectDrivable(const ReferencePath& found) const {
    EXPECT_TRUE(found.tight.empty());
    EXPECT_LT(largestKappa(found.path), 1.02 * vehicle.maxKappa());
  }
};

///   b          a corner of 90 degrees, drawn with no point between
///   |
///   +---- a
TEST_F(CoarseJunction, IsDrivenRoundWithinTheLanes) {
  builder.lane("a", {{0, 0}, {60, 0}}).lane("b", {{60, 0}, {60, 60}}).follow({"a", "b"});
  const ReferencePath found = along({"a", 0}, {"b", 60});
  expectDrivable(found);
  for (const ReferencePoint& point : found.path) {
    const Point2d position = point.pose().position();
    const double beside = std::min(std::abs(position.y()), std::abs(position.x() - 60.0));
    EXPECT_LT(beside, 1.5 * (MapBuilder::kLaneWidth / 2.0 - vehicle.width / 2.0))
        << at(position) << ", farther only across the corner";
  }
}

TEST_F(CoarseJunction, IsDrivenByALongVehicleOnTheNeighbourLaneWhereItMust) {
  builder.lane("a", {{0, 0}, {60, 0}}).arc("turn", {60, 0, 0}, 9.0, -M_PI / 2).lane("b", {{69, -9}, {69, -69}});
  builder.lane("a2", {{0, MapBuilder::kLaneWidth}, {60, MapBuilder::kLaneWidth}}).beside({"a2", "a"});
  builder.lane("b2", {{69 + MapBuilder::kLaneWidth, -9}, {69 + MapBuilder::kLaneWidth, -69}})
      .beside({"b2", "b"})
      .follow({"a", "turn", "b"});
  vehicle.wheelbase = 6.0;
  vehicle.front_overhang = 2.5;
  vehicle.min_turning_radius = 8.0;
  vehicle.width = 2.5;
  const ReferencePath found = along({"a", 0}, {"b", 60});
  expectDrivable(found);
  double left = 0.0;
  for (const ReferencePoint& point : found.path) left = std::max(left, point.x < 60.0 ? point.y : point.x - 69.0);
  EXPECT_GT(left, MapBuilder::kLaneWidth / 2.0 - vehicle.width / 2.0) << "it swings out";
  EXPECT_LT(left, 1.5 * MapBuilder::kLaneWidth - vehicle.width / 2.0) << "no farther than the neighbour lane";
}

TEST_F(CoarseJunction, SaysWhereACornerOfALongVehicleLeavesTheLanes) {
  builder.lane("a", {{0, 0}, {60, 0}}).arc("turn", {60, 0, 0}, 9.0, -M_PI / 2).lane("b", {{69, -9}, {69, -69}});
  builder.follow({"a", "turn", "b"});
  EXPECT_TRUE(along({"a", 0}, {"b", 60}).left.empty()) << "a car has room";
  vehicle.wheelbase = 6.0;
  vehicle.front_overhang = 2.5;
  vehicle.min_turning_radius = 8.0;
  vehicle.width = 2.5;
  const ReferencePath found = along({"a", 0}, {"b", 60});
  ASSERT_FALSE(found.left.empty());
  EXPECT_GT(found.left[0].excess, 0.2);
  EXPECT_LT(found.left[0].excess, 3.0);
  EXPECT_LT((found.left[0].position - Point2d(60, 0)).norm(), 15.0);
  const std::string told = describe(map(), found.left).front();
  EXPECT_NE(told.find("a corner of the vehicle leaves lane "), std::string::npos) << told;
}

TEST_F(CoarseJunction, IsDrivenThroughWhereLinkedLanesLieApart) {
  for (const double ahead : {-3.0, -1.0, 0.0, 1.0, 1.5}) {
    for (const double beside : {-0.9, -0.5, 0.0, 0.8}) {
      SCOPED_TRACE(testing::Message() << ahead << " m ahead, " << beside << " m to the left");
      builder = {};
      builder.lane("a", {0, 0}, {50, 0}).lane("b", {50 + ahead, beside}, {100, beside}).follow({"a", "b"});
      const ReferencePath found = along({"a", 5}, {"b", 45});
      expectDrivable(found);
      for (std::size_t i = 1; i < found.path.size(); ++i) EXPECT_GT(found.path[i].x, found.path[i - 1].x);
      for (const ReferencePoint& point : found.path) EXPECT_LT(std::abs(point.heading), 0.5);
    }
  }
}

TEST_F(CoarseJunction, IsDrivenStraightOnWhereALaneFoldsBackOnItself) {
  for (const double back : {0.02, 0.5, 2.0, 5.0}) {
    SCOPED_TRACE(back);
    builder = {};
    builder.lane("a", {{0, 0}, {30, 0}, {30 - 0.5 * back, 0}, {30 - back, 0}, {30.1, 0}, {60, 0}});
    const double length = builder.build()->lanes()[0].length();
    const ReferencePath found = along({"a", 5}, {"a", length - 5.0});
    expectDrivable(found);
    EXPECT_NEAR(found.path.back().s, 50.0, 0.1);
    EXPECT_LT(largestKappa(found.path), 0.01);
  }
}

///   ------+
///         |  2 m: no vehicle turns here
///   ------+
TEST_F(CoarseJunction, SaysSoWhereTheVehicleCannotTurn) {
  builder.lane("there", {0, 0}, {50, 0}).arc("turn", {50, 0, 0}, 1.0, M_PI).lane("back", {50, 2}, {0, 2});
  builder.follow({"there", "turn", "back"});
  const ReferencePath found = along({"there", 0}, {"back", 50});
  ASSERT_FALSE(found.tight.empty());
  EXPECT_LT(found.tight[0].radius, 3.0);
  const std::string told = describe(map(), found.tight, vehicle).front();
  EXPECT_NE(told.find("lane turn leaves no room for more than a radius of "), std::string::npos) << told;
  EXPECT_NE(told.find("the vehicle needs 5.00 m (~vehicle/min_turning_radius)"), std::string::npos) << told;
  path_params.refuse_undrivable = true;
  const Route route = drive({"there", 0}, {"back", 50});
  EXPECT_THAT_REFUSED(referencePath(map(), route, vehicle, path_params, {}), NoPath, "refuse_undrivable");
}

TEST_F(CoarseJunction, CanBeCancelled) {
  builder.lane("a", {0, 0}, {200, 0});
  const Route route = drive({"a", 0}, {"a", 200});
  const CancelSource source;
  source.cancel();
  EXPECT_THROW(referencePath(map(), route, vehicle, path_params, {0.0, std::nullopt, source.token()}), Cancelled);
}

///   a ring of four quarter circles of 15 m
TEST(ReferencePath, DrivesALoop) {
  MapBuilder builder;
  for (int i = 0; i < 4; ++i) {
    const double heading = i * M_PI / 2;
    const Point2d begin = 15.0 * unitVector(heading - M_PI / 2);
    builder.arc(std::string(1, static_cast<char>('a' + i)), {begin.x(), begin.y(), heading}, 15.0, M_PI / 2);
  }
  builder.follow({"a", "b", "c", "d", "a"});
  const auto map = builder.build();
  const Router router(map, {});
  const Route route = router.findRoute({{{0, 10.0}}, {}, {{0, 9.0}}, {}}, CancelToken());
  Path path = referencePath(*map, route, VehicleParams(), ReferencePathParams(), {}).path;
  limitSpeeds(VehicleParams(), &path);
  EXPECT_TRUE(isContinuous(path, 0.55));
  EXPECT_NEAR(path.back().s, 2.0 * M_PI * 15.0 - 1.0, 0.2);
  for (const ReferencePoint& point : path) EXPECT_NEAR(point.kappa, 1.0 / 15.0, 0.01);
}

TEST(ReferencePath, RefusesParametersOutOfRange) {
  ReferencePathParams params;
  params.spacing = 0.0;
  EXPECT_THAT_REFUSED(params.validate(), InvalidParameter, "path_spacing is 0");
  params.spacing = 0.5;
  EXPECT_NO_THROW(params.validate());
}

}  // namespace
}  // namespace external_command
