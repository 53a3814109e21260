// SPDX-License-Identifier: Apache-2.0
// Which lanes a route takes where 10 cm could decide: LaneWayTool and Router together.
#include <gtest/gtest.h>

#include "external_command/map/map_reader.h"
#include "external_command/routing/black_list.h"
#include "external_command/routing/lane_way_tool.h"
#include "support/map_builder.h"
#include "support/route_matchers.h"
#include "support/routing_world.h"

namespace external_command {
namespace {

/// A place to go to, with a heading or without.
struct Place {
  double x, y;
  std::optional<double> heading = {};
};

class Trip {
 public:
  explicit Trip(std::shared_ptr<const HdMap> map) : map_(std::move(map)), router_(map_, {}), tool_(*map_, {}) {}

  Route drive(const Pose2d& vehicle, const std::vector<Place>& via, const Place& goal) const {
    RouteQuery query{tool_.fromVehicle(vehicle), {}, points(goal), {}};
    for (const Place& place : via) query.via.push_back(points(place));
    const Route route = router_.findRoute(query, CancelToken());
    EXPECT_TRUE(isConnected(route, *map_));
    return route;
  }

  Route drive(const Pose2d& vehicle, const Place& goal) const { return drive(vehicle, {}, goal); }
  std::string ids(const Route& route) const { return laneIds(route, *map_); }
  const HdMap& map() const { return *map_; }

 private:
  std::vector<LanePoint> points(const Place& place) const {
    return tool_.fromPose({place.x, place.y}, place.heading, "end_pose");
  }

  std::shared_ptr<const HdMap> map_;
  Router router_;
  LaneWayTool tool_;
};

class DemoTown : public testing::Test {
 protected:
  const Trip trip{readMap(EC_SOURCE_DIR "/maps/demo_town/base_map.bin", {})};
};

TEST_F(DemoTown, IsCrossedTheSameFromTenCentimetresToEitherSide) {
  for (const double y : {194.55, 194.65, 194.75, 194.85}) {
    EXPECT_NEAR(trip.drive({203, y, 0}, {280, 194.75}).distance, 77.0, 0.5) << "from y = " << y;
  }
}

TEST_F(DemoTown, HasItsGoalReachedAMillimetreBehindTheVehicle) {
  EXPECT_EQ(trip.drive({90, 194.75, 0}, {89.999, 194.75}).distance, 0.0);
  EXPECT_EQ(trip.drive({90, 194.75, 0}, {89.6, 194.75}).distance, 0.0);
  EXPECT_GT(trip.drive({90, 194.75, 0}, {89.3, 194.75}).distance, 500.0);
  EXPECT_NEAR(trip.drive({90, 194.75, 0}, {{120, 194.75}, {119.999, 194.75}}, {150, 194.75}).distance, 60.0, 1e-6);
}

/// Six lanes cross at the way point, the nearest 1.5 m off, four more within 0.6 m of that.
TEST_F(DemoTown, IsCrossedByAWayPointInAJunctionOnWhicheverOfItsLanesSuitsTheRoute) {
  const Route route = trip.drive({90, 194.75, 0}, {{220, 120}}, {478, 338.25});
  EXPECT_NEAR(route.distance, 776.6, 0.5) << "510 m without it";
}

///                straight
///   in ----------+--------> out_e      straight and right begin on top of each other
///                 \\ right
///                  | out_s
class Fork : public testing::Test {
 protected:
  static std::shared_ptr<const HdMap> build() {
    MapBuilder builder;
    builder.lane("in", {-50, 0}, {0, 0}).lane("straight", {0, 0}, {20, 0}).lane("out_e", {20, 0}, {80, 0});
    builder.arc("right", {0, 0, 0}, 20.0, -M_PI / 2.0).lane("out_s", {20, -20}, {20, -80});
    builder.follow({"in", "straight", "out_e"}).follow({"in", "right", "out_s"});
    return builder.build();
  }
  const Trip trip{build()};
};

TEST_F(Fork, IsLeftByEitherBranchFromWhereBothAreNear) {
  for (const double y : {0.0, -0.1, 0.1}) {
    const Route east = trip.drive({1.0, y, -0.05}, {60, 0});
    EXPECT_EQ(trip.ids(east), "straight out_e");
    EXPECT_NEAR(east.distance, 59.0, 0.1);
    EXPECT_EQ(trip.ids(trip.drive({1.0, y, -0.05}, {20, -60})), "right out_s");
  }
}

TEST_F(Fork, IsPassedByAWayPointOnItInEitherDirection) {
  const Route east = trip.drive({-20, 0, 0}, {{1.0, -0.1}}, {60, 0});
  EXPECT_NEAR(east.distance, 80.0, 0.1);
  EXPECT_EQ(trip.ids(trip.drive({-20, 0, 0}, {{1.0, 0.1}}, {20, -60})), "in right out_s");
}

TEST_F(Fork, EndsWhereALaneBeginsOnThatLane) {
  EXPECT_EQ(trip.ids(trip.drive({-20, 0, 0}, {20, 0, 0.0})), "in straight out_e");
  EXPECT_EQ(trip.ids(trip.drive({-20, 0, 0}, {19.8, 0, 0.0})), "in straight");
}

TEST_F(Fork, IsLeftByTheBranchThatTheVehicleHasTurnedInto) {
  //   0.8 m beside the lane straight on, but turned by 0.3 rad
  EXPECT_EQ(trip.ids(trip.drive({5.9, -0.89, -0.3}, {20, -60})), "right out_s");
  EXPECT_THROW(trip.drive({7.65, -1.0, -0.39}, {60, 0}), NoRoute);
}

TEST_F(Fork, TakesTheBranchThatTheWayPointIsClearlyOn) {
  EXPECT_THROW(trip.drive({-20, 0, 0}, {{18.0, -11.5}}, {60, 0}), NoRoute);
}

/// One strip of road: east and west on top of each other.
TEST(TwoWayLane, IsDrivenInTheDirectionThatLeadsToTheGoal) {
  MapBuilder builder;
  builder.lane("east", {0, 0}, {200, 0}).lane("west", {200, 0}, {0, 0});
  const Trip trip(builder.build());
  const Route west = trip.drive({150, 0, M_PI}, {50, 0});
  EXPECT_EQ(trip.ids(west), "west");
  EXPECT_NEAR(west.distance, 100.0, 1e-9);
  EXPECT_EQ(trip.ids(trip.drive({50, 0, 0}, {150, 0})), "east");
  EXPECT_THROW(trip.drive({50, 0, 0}, {150, 0, M_PI}), NoRoute) << "there is nowhere to turn round";
}

/// One lane for both directions, and one whose direction is said to be BACKWARD.
class OneLaneForBothDirections : public testing::Test {
 protected:
  static std::shared_ptr<const HdMap> build() {
    MapBuilder builder;
    builder.lane("two_way", {0, 0}, {200, 0}).lane("back", {200, 50}, {0, 50});
    builder["two_way"].direction = LaneDirection::kBidirection;
    builder["back"].direction = LaneDirection::kBackward;
    return builder.build();
  }
  const Trip trip{build()};
};

TEST_F(OneLaneForBothDirections, IsDrivenEitherWay) {
  EXPECT_NEAR(trip.drive({50, 0, 0}, {150, 0}).distance, 100.0, 1e-9);
  const Route west = trip.drive({150, 0, M_PI}, {50, 0});
  EXPECT_EQ(trip.ids(west), "two_way");
  EXPECT_NEAR(west.distance, 100.0, 1e-9);
  EXPECT_NEAR(trip.map().lane(west.steps[0].lane).statedS(west.steps[0].from_s), 150.0, 1e-9);
  EXPECT_THROW(trip.drive({150, 0, M_PI}, {180, 0}), NoRoute) << "there is nowhere to turn round";
}

TEST_F(OneLaneForBothDirections, IsDrivenAlongItsCentreLineWhereItSaysBackward) {
  EXPECT_NEAR(trip.drive({150, 50, M_PI}, {50, 50}).distance, 100.0, 1e-9);
}

TEST_F(OneLaneForBothDirections, IsBlackListedInBoth) {
  const auto ranges = blackList(trip.map(), {{"two_way", 60.0, 70.0}}, {});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[1].from_s, 130.0, 1e-9);
  EXPECT_NEAR(ranges[1].to_s, 140.0, 1e-9);
}

/// Lane b begins 3 m before lane a ends.
TEST(OverlappingLanes, AreDrivenStraightOn) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {50, 0}).lane("b", {47, 0}, {100, 0}).follow({"a", "b"});
  const Trip trip(builder.build());
  const Route route = trip.drive({5, 0, 0}, {90, 0});
  EXPECT_NEAR(route.distance, 85.0, 1e-9);
  ASSERT_EQ(route.steps.size(), 2u);
  EXPECT_NEAR(route.steps[1].from_s, 3.0, 1e-9);
}

///   n_west <------------- a ring road: the far lane is reached by way of the end
///   s_east ------------->
class TwoWayStreet : public testing::Test {
 protected:
  static std::shared_ptr<const HdMap> build() {
    MapBuilder builder;
    builder.lane("s_east", {0, 0}, {400, 0}).lane("n_west", {400, MapBuilder::kLaneWidth}, {0, MapBuilder::kLaneWidth});
    builder.lane("turn", std::vector<Point2d>{{400, 0}, {410, 1}, {410, 2.5}, {400, MapBuilder::kLaneWidth}});
    builder.follow({"s_east", "turn", "n_west"});
    return builder.build();
  }
  const Trip trip{build()};
};

TEST_F(TwoWayStreet, ReachesAGoalBetweenItsLanesOnTheSideItComesBy) {
  for (const double y : {1.3, 1.75, 2.2}) {
    EXPECT_NEAR(trip.drive({10, 0, 0}, {100, y}).distance, 90.0, 1e-6) << "goal at y = " << y;
  }
}

TEST_F(TwoWayStreet, ReachesAGoalOnTheFarLaneThere) {
  EXPECT_GT(trip.drive({10, 0, 0}, {100, MapBuilder::kLaneWidth}).distance, 600.0);
  EXPECT_GT(trip.drive({10, 0, 0}, {100, MapBuilder::kLaneWidth + 5.0}).distance, 600.0)
      << "before a house on that side";
}

///   left  ---------------->
///   right ---------------->
class ParallelLanes : public testing::Test {
 protected:
  static std::shared_ptr<const HdMap> build() {
    MapBuilder builder;
    builder.lane("left", {0, MapBuilder::kLaneWidth}, {400, MapBuilder::kLaneWidth})
        .lane("right", {0, 0}, {400, 0})
        .beside({"left", "right"});
    return builder.build();
  }
  const Trip trip{build()};
};

TEST_F(ParallelLanes, ArePassedByAWayPointBetweenThemWithoutAChange) {
  for (const double y : {1.5, 1.75, 2.0}) {
    EXPECT_EQ(trip.ids(trip.drive({10, 0, 0}, {{200, y}}, {390, 0})), "right");
    EXPECT_EQ(trip.ids(trip.drive({10, MapBuilder::kLaneWidth, 0}, {{200, y, 0.0}}, {390, MapBuilder::kLaneWidth})),
              "left");
  }
}

TEST_F(ParallelLanes, AreChangedForAWayPointThatIsClearlyOnTheOther) {
  EXPECT_EQ(trip.ids(trip.drive({10, 0, 0}, {{200, MapBuilder::kLaneWidth}}, {390, 0})), "right left right");
  EXPECT_EQ(trip.ids(trip.drive({10, 0, 0}, {390, 2.3})), "right left");
}

TEST_F(ParallelLanes, AreStartedOnEitherFromTheLineBetween) {
  EXPECT_EQ(trip.ids(trip.drive({10, 1.72, 0}, {390, MapBuilder::kLaneWidth})), "left");
  EXPECT_EQ(trip.ids(trip.drive({10, 1.78, 0}, {390, 0})), "right");
}

}  // namespace
}  // namespace external_command
