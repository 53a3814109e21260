// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/routing_world.h"

namespace external_command {
namespace {

///   a1 ----> a2 ----> a3      100 m each; side by side all the way
///   b1 ----> b2 ----> b3
class TwoLanes : public RoutingWorld {
 protected:
  TwoLanes() {
    for (const char* i : {"1", "2", "3"}) {
      const double x = 100.0 * (*i - '1');
      builder.lane(std::string("a") + i, {x, MapBuilder::kLaneWidth}, {x + 100, MapBuilder::kLaneWidth});
      builder.lane(std::string("b") + i, {x, 0}, {x + 100, 0});
      builder.beside({std::string("a") + i, std::string("b") + i});
    }
    builder.follow({"a1", "a2", "a3"}).follow({"b1", "b2", "b3"});
  }

  void drawLine(const std::string& left, const std::string& right, const std::vector<BoundaryTypeChange>& types) {
    builder[left].right.types = types;
    builder[right].left.types = types;
  }

  static RouteStep changeOf(const Route& route) {
    for (const RouteStep& step : route.steps) {
      if (step.change_after != LaneChange::kNone) return step;
    }
    ADD_FAILURE() << "no lane change";
    return {};
  }
};

TEST_F(TwoLanes, KeepsItsLaneWhereNothingIsGainedByChanging) {
  EXPECT_EQ(ids(drive({"a1", 10}, {"a3", 90})), "a1 a2 a3");
  EXPECT_EQ(ids(drive({"b1", 10}, {"b3", 90})), "b1 b2 b3");
}

TEST_F(TwoLanes, CountsProgressOnceOnALaneChange) {
  const Route route = drive({"b1", 10}, {"a1", 90});
  EXPECT_NEAR(route.distance, 80.0, 1e-9);
  EXPECT_EQ(changeOf(route).change_after, LaneChange::kLeft);
  EXPECT_EQ(changeOf(drive({"a1", 10}, {"b1", 90})).change_after, LaneChange::kRight);
}

TEST_F(TwoLanes, GivesAChangeTheRoomThereIs) {
  EXPECT_NEAR(changeOf(drive({"b1", 10}, {"a1", 60})).change_room, 50.0, 1e-9);
  EXPECT_NEAR(changeOf(drive({"b1", 90}, {"a2", 20})).change_room, 30.0, 1e-9) << "over two pieces";
  EXPECT_NEAR(changeOf(drive({"b1", 10}, {"a3", 60})).change_room, 100.0, 1e-9) << "more is of no use";
}

TEST_F(TwoLanes, IsDoneWithAChangeAtAWayPoint) {
  const Route route = drive({"b1", 10}, {{{"a1", 40}}}, {"a3", 60});
  EXPECT_NEAR(changeOf(route).change_room, 30.0, 1e-9);
  EXPECT_NEAR(drive({"b1", 10}, {{{"a1", 40}}, {{"b2", 5}}}, {"a3", 60}).distance, 250.0, 1e-9);
}

TEST_F(TwoLanes, ChangesNeitherOverASolidLineNorOverACurb) {
  for (const BoundaryType type :
       {BoundaryType::kSolidWhite, BoundaryType::kSolidYellow, BoundaryType::kDoubleYellow, BoundaryType::kCurb}) {
    for (const char* i : {"1", "2", "3"}) drawLine(std::string("a") + i, std::string("b") + i, {{0.0, type}});
    EXPECT_THAT_REFUSED(drive({"b1", 10}, {"a3", 90}), NoRoute, "3 lanes of 6 were reached");
  }
}

TEST_F(TwoLanes, ChangesOverDottedUnknownVirtualAndUnstatedLines) {
  for (const BoundaryType type : {BoundaryType::kDottedWhite, BoundaryType::kDottedYellow, BoundaryType::kUnknown}) {
    drawLine("a1", "b1", {{0.0, type}});
    EXPECT_NEAR(drive({"b1", 10}, {"a1", 90}).distance, 80.0, 1e-9);
  }
  drawLine("a1", "b1", {});
  EXPECT_NEAR(drive({"b1", 10}, {"a1", 90}).distance, 80.0, 1e-9);
  drawLine("a1", "b1", {{0.0, BoundaryType::kSolidWhite}});
  builder["b1"].left.is_virtual = true;
  EXPECT_NEAR(drive({"b1", 10}, {"a1", 90}).distance, 80.0, 1e-9);
}

TEST_F(TwoLanes, SaysWhereALineMayNotBeCrossed) {
  for (const char* i : {"1", "2", "3"}) {
    drawLine(std::string("a") + i, std::string("b") + i, {{0.0, BoundaryType::kSolidWhite}});
  }
  EXPECT_THAT_REFUSED(drive({"b1", 10}, {"a3", 90}), NoRoute,
                      "lies beside lane b1, but the line between them may not be crossed");
}

TEST_F(TwoLanes, TakesTheLineAsTheOtherLaneStatesItWhereItsOwnDoesNot) {
  builder["b1"].left.types.clear();
  builder["a1"].right.types = {{0.0, BoundaryType::kSolidWhite}};
  EXPECT_THAT_REFUSED(drive({"b1", 10}, {"a1", 90}), NoRoute, "no route");
}

TEST_F(TwoLanes, ChangesWhereTheLineCanBeCrossed) {
  //   b1: solid up to 50 m, dotted up to 70 m, solid again
  drawLine("a1", "b1",
           {{0, BoundaryType::kSolidWhite}, {50, BoundaryType::kDottedWhite}, {70, BoundaryType::kSolidWhite}});
  const RouteStep change = changeOf(drive({"b1", 10}, {"a1", 90}));
  EXPECT_NEAR(change.to_s, 70.0, 1e-9);
  EXPECT_NEAR(change.change_room, 20.0, 1e-9);
  EXPECT_THAT_REFUSED(drive({"b1", 65}, {"a1", 90}), NoRoute, "there is no room to change lanes, from lane b1");
}

TEST_F(TwoLanes, NeedsRoomForAChange) {
  params.min_lane_change_length = 20.0;
  params.min_turning_radius = 23.0;  // two arcs with their margin need 19.8 m
  EXPECT_TRUE(drive({"b1", 10}, {"a1", 30.1}).warnings.empty());
  EXPECT_THAT_REFUSED(drive({"b1", 10}, {"a1", 29.7}), NoRoute, "a change needs 20.00 m (~min_lane_change_length)");
}

TEST_F(TwoLanes, ChangesInLessRoomThanItShouldHaveWhereNothingElseHelpsAndSaysSo) {
  const Route route = drive({"b1", 10}, {"a1", 19});
  ASSERT_EQ(route.warnings.size(), 1u);
  EXPECT_EQ(route.warnings[0].find("the change from lane b1 to lane a1 has only 9.00 m of the 10.00 m"), 0u);
}

TEST_F(TwoLanes, DoesNotChangeInLessRoomThanTheTurningCircleNeeds) {
  //   two arcs of 5 m radius take 7.60 m; 8.67 m where they are to be driven into and out of
  EXPECT_EQ(ids(drive({"b1", 10}, {"a1", 18.7})), "b1 a1");
  EXPECT_THAT_REFUSED(drive({"b1", 10}, {"a1", 18.6}), NoRoute, "turning radius of 5.00 m");
  params.min_turning_radius = 6.0;
  EXPECT_THAT_REFUSED(drive({"b1", 10}, {"a1", 19}), NoRoute, "turning radius of 6.00 m");
}

TEST_F(TwoLanes, NeedsMoreRoomWhereTheLanesLieFurtherApart) {
  for (const char* lane : {"b1", "b2", "b3"}) {
    for (Point2d& point : builder[lane].center) point.y() -= 2.5;  // 6 m apart: two arcs take 10.7 m
  }
  EXPECT_TRUE(drive({"b1", 10}, {"a1", 20.8}).warnings.empty());
  EXPECT_THAT_REFUSED(drive({"b1", 10}, {"a1", 20.6}), NoRoute, "no room to change lanes");
}

TEST_F(TwoLanes, DoesNotChangeInTooLittleRoomForASmallGain) {
  //   Only the last 9 m of b1 can be crossed; by the bridge it is 24 m further to a2.
  params.lane_change_price = 0.0;
  drawLine("a1", "b1", {{0, BoundaryType::kSolidWhite}, {91, BoundaryType::kDottedWhite}});
  drawLine("a2", "b2", {{0, BoundaryType::kSolidWhite}});
  builder.lane("bridge", std::vector<Point2d>{{100, 0}, {112, 2}, {100, MapBuilder::kLaneWidth}})
      .follow({"b1", "bridge", "a2"});
  EXPECT_EQ(ids(drive({"b1", 0}, {"a2", 50})), "b1 bridge a2");
  params.tight_lane_change_price = 20.0;
  EXPECT_EQ(ids(drive({"b1", 0}, {"a2", 50})), "b1 a1 a2");
}

TEST_F(TwoLanes, ChangesOnlyWhereThatSavesMoreThanItsPrice) {
  //   The bridge leads from b1 to a2 as a change does, and is 24 m longer.
  drawLine("a2", "b2", {{0, BoundaryType::kSolidWhite}});
  builder.lane("bridge", std::vector<Point2d>{{100, 0}, {112, 2}, {100, MapBuilder::kLaneWidth}})
      .follow({"b1", "bridge", "a2"});
  const Route around = drive({"b1", 0}, {"a2", 50});
  EXPECT_EQ(ids(around), "b1 bridge a2");
  EXPECT_NEAR(around.cost, around.distance, 1e-9);
  params.lane_change_price = 20.0;
  const Route across = drive({"b1", 0}, {"a2", 50});
  EXPECT_EQ(ids(across), "b1 a1 a2");
  EXPECT_NEAR(across.distance, 150.0, 1e-9) << "metres driven, without the price";
  EXPECT_NEAR(across.cost, 170.0, 1e-9);
}

TEST_F(TwoLanes, PassesABlackListedPartOnTheLaneBesideIt) {
  //   a1 ---xxx---> a2     the block is 40 ... 60
  //   b1 ---------> b2
  const Route route = drive({"a1", 0}, {}, {"a2", 50}, {{"a1", 40, 60}});
  EXPECT_EQ(ids(route), "a1 b1 b2 a2") << "the change back may be done until the goal";
  EXPECT_NEAR(route.distance, 150.0, 1e-9);
  EXPECT_EQ(ids(drive({"a1", 0}, {}, {"b2", 50}, {{"a1", 40, 60}})), "a1 b1 b2");
  EXPECT_EQ(ids(drive({"a1", 60.1}, {}, {"a2", 50}, {{"a1", 40, 60}})), "a1 a2");
}

TEST_F(TwoLanes, CannotPassABlackListedPartWithoutRoomBeforeIt) {
  EXPECT_THAT_REFUSED(drive({"a1", 35}, {}, {"a2", 50}, {{"a1", 40, 60}}), NoRoute,
                      "the black list leaves no room to change lanes, from lane a1 to lane b1 (5.00 m); "
                      "without the black list there is a route");
}

TEST_F(TwoLanes, CannotPassABlackListThatCoversBothLanes) {
  EXPECT_THAT_REFUSED(drive({"a1", 0}, {}, {"a2", 50}, {{"a1", 40, 60}, {"b1", 60, 70}}), NoRoute,
                      "the black list cuts it at lane a1");
  EXPECT_EQ(ids(drive({"a1", 0}, {}, {"a2", 50}, {{"a1", 40, 60}, {"b1", 71, 72}})), "a1 b1 a1 a2");
}

TEST_F(TwoLanes, ChangesToAndFroThroughASlalom) {
  const Route route =
      drive({"a1", 0}, {}, {"a3", 100}, {{"a1", 30, 40}, {"b1", 70, 80}, {"a2", 20, 30}, {"b2", 60, 70}});
  EXPECT_NEAR(route.distance, 300.0, 1e-9);
  EXPECT_EQ(ids(route), "a1 b1 a1 a2 b2 a2 a3");
}

TEST_F(TwoLanes, ChangesOnlyToLanesForDriving) {
  for (const char* lane : {"a1", "a2", "a3"}) builder[lane].type = LaneType::kShoulder;
  EXPECT_EQ(ids(drive({"b1", 10}, {"b3", 10})), "b1 b2 b3");
  EXPECT_THAT_REFUSED(drive({"b1", 10}, {}, {"b2", 50}, {{"b1", 40, 60}}), NoRoute, "the black list cuts it");
}

///   a ----------------------> 60 m, cut into pieces of 4 m at the side of b
///   b b b b b b b b b b b b b
TEST(LaneChange, RunsOverManyShortPieces) {
  MapBuilder builder;
  for (int i = 0; i < 15; ++i) {
    const std::string k = std::to_string(i);
    builder.lane("a" + k, {4.0 * i, MapBuilder::kLaneWidth}, {4.0 * i + 4, MapBuilder::kLaneWidth})
        .lane("b" + k, {4.0 * i, 0}, {4.0 * i + 4, 0});
    builder.beside({"a" + k, "b" + k});
    if (i == 0) continue;
    const std::string before = std::to_string(i - 1);
    builder.follow({"a" + before, "a" + k}).follow({"b" + before, "b" + k});
  }
  const auto map = builder.build();
  const Router router(map, {});
  RouteQuery query{{{laneIndex(*map, "b0"), 1.0}}, {}, {{laneIndex(*map, "a14"), 3.0}}, {}};
  const Route route = router.findRoute(query, CancelToken());
  EXPECT_TRUE(isConnected(route, *map));
  EXPECT_NEAR(route.distance, 58.0, 1e-9);
  EXPECT_TRUE(route.warnings.empty());

  query.goals = {{laneIndex(*map, "a2"), 2.0}};  // 9 m away
  EXPECT_EQ(router.findRoute(query, CancelToken()).warnings.size(), 1u);
  query.goals = {{laneIndex(*map, "a1"), 1.0}};  // 4 m away
  EXPECT_THROW(router.findRoute(query, CancelToken()), NoRoute);
}

///   left  -------------------->
///   mid   -------------------->  of one piece of 100 m each
///   right -------------------->
class ThreeLanes : public RoutingWorld {
 protected:
  ThreeLanes() {
    builder.lane("left", {0, 2 * MapBuilder::kLaneWidth}, {100, 2 * MapBuilder::kLaneWidth})
        .lane("mid", {0, MapBuilder::kLaneWidth}, {100, MapBuilder::kLaneWidth});
    builder.lane("right", {0, 0}, {100, 0}).beside({"left", "mid", "right"});
  }
};

TEST_F(ThreeLanes, SharesTheRoomBetweenTwoChanges) {
  const Route route = drive({"right", 0}, {"left", 80});
  EXPECT_EQ(ids(route), "right mid left");
  EXPECT_NEAR(route.distance, 80.0, 1e-9);
  EXPECT_NEAR(route.steps[0].change_room, 40.0, 1e-6);
  EXPECT_NEAR(route.steps[1].change_room, 40.0, 1e-6);
}

TEST_F(ThreeLanes, NeedsRoomForEachOfTwoChanges) {
  EXPECT_TRUE(drive({"right", 0}, {"left", 20.1}).warnings.empty());
  EXPECT_EQ(drive({"right", 0}, {"left", 18}).warnings.size(), 2u);
  EXPECT_THAT_REFUSED(drive({"right", 0}, {"left", 17}), NoRoute, "no room to change lanes, from lane right");
}

///   long --------------------> 100 m      one lane beside two that follow each other, which the file states as two
///   s1 --------> s2 --------->            neighbours of the long one
TEST(LaneChange, KnowsWhichPartOfALongLaneLiesBesideAShortOne) {
  MapBuilder builder;
  builder.lane("long", {0, MapBuilder::kLaneWidth}, {100, MapBuilder::kLaneWidth})
      .lane("s1", {0, 0}, {50, 0})
      .lane("s2", {50, 0}, {100, 0});
  builder.follow({"s1", "s2"}).beside({"long", "s1"}).beside({"long", "s2"});
  const auto map = builder.build();
  const Router router(map, {});
  const auto distance = [&](const char* from, double s, const char* to, double t) {
    const RouteQuery query{{{laneIndex(*map, from), s}}, {}, {{laneIndex(*map, to), t}}, {}};
    const Route route = router.findRoute(query, CancelToken());
    EXPECT_TRUE(isConnected(route, *map));
    EXPECT_TRUE(beginsAndEndsAsAsked(route, query));
    return route.distance;
  };
  EXPECT_NEAR(distance("long", 10, "s2", 40), 80.0, 1e-6);
  EXPECT_NEAR(distance("s1", 45, "long", 60), 15.0, 1e-6) << "the change begins beside s1 and ends beside s2";
  EXPECT_NEAR(distance("long", 45, "s2", 10), 15.0, 1e-6);
  EXPECT_THROW(distance("long", 60, "s1", 40), NoRoute);
}

///   outer: an arc of 40 m radius; inner: one of 36.5 m beside it, both with 20 m straight ahead
TEST(LaneChange, CountsLanesSideBySideAsTheOneThatIsLeftLast) {
  MapBuilder builder;
  builder.arc("outer", {0, 0, 0}, 40.0, M_PI / 2)
      .arc("inner", {0, MapBuilder::kLaneWidth, 0}, 40.0 - MapBuilder::kLaneWidth, M_PI / 2);
  builder.beside({"inner", "outer"});
  builder.lane("outer2", {40, 40}, {40, 60})
      .lane("inner2", {40 - MapBuilder::kLaneWidth, 40}, {40 - MapBuilder::kLaneWidth, 60});
  builder.beside({"inner2", "outer2"}).follow({"outer", "outer2"}).follow({"inner", "inner2"});
  const auto map = builder.build();
  RouterParams params;
  params.lane_change_price = 0.0;
  const Router router(map, params);
  const double inner = map->lane(laneIndex(*map, "inner")).length();
  const RouteQuery query{{{laneIndex(*map, "outer"), 0.0}}, {}, {{laneIndex(*map, "outer2"), 20.0}}, {}};
  const Route route = router.findRoute(query, CancelToken());
  EXPECT_TRUE(isConnected(route, *map));
  EXPECT_NEAR(route.distance, inner + 20.0, 1e-6) << "the inner lane is shorter, and there is room to return";
}

///   inner, outer: 40 m straight, a quarter of a circle of 9 and 12.5 m, 40 m straight
class BendOfTwoLanes : public RoutingWorld {
 protected:
  BendOfTwoLanes() {
    std::vector<Point2d> outer = {{0, 0}}, inner = {{0, MapBuilder::kLaneWidth}};
    for (int i = 0; i <= 10; ++i) {
      const Point2d outward = unitVector(-M_PI / 2.0 + 0.05 * M_PI * i), center(40.0, 9.0 + MapBuilder::kLaneWidth);
      outer.push_back(center + (9.0 + MapBuilder::kLaneWidth) * outward);
      inner.push_back(center + 9.0 * outward);
    }
    outer.emplace_back(49.0 + MapBuilder::kLaneWidth, 49.0 + MapBuilder::kLaneWidth);
    inner.emplace_back(49.0, 49.0 + MapBuilder::kLaneWidth);
    builder.lane("outer", outer).lane("inner", inner).beside({"inner", "outer"});
  }
};

TEST_F(BendOfTwoLanes, AreChangedBeforeOrAfterTheBend) {
  EXPECT_NO_THROW(drive({"outer", 20}, {"inner", 35}));
  EXPECT_NO_THROW(drive({"outer", 42}, {"inner", 75})) << "in the straight after the bend";
}

TEST_F(BendOfTwoLanes, AreNotChangedInTheBend) {
  EXPECT_THAT_REFUSED(drive({"outer", 41}, {"inner", 53}), NoRoute, "no room to change lanes");
}

///   ramp ----\___  comes up to road from 10 m beside it, and runs alongside from x = 60 m on
///   road ---------------->
TEST(LaneChange, NeedsTheRoomOfWhereItIsMade) {
  MapBuilder builder;
  builder.lane("ramp", std::vector<Point2d>{{0, 10 + MapBuilder::kLaneWidth},
                                            {20, 10 + MapBuilder::kLaneWidth},
                                            {60, MapBuilder::kLaneWidth},
                                            {120, MapBuilder::kLaneWidth}});
  builder.lane("road", {0, 0}, {120, 0}).beside({"ramp", "road"});
  const auto map = builder.build();
  const Router router(map, {});
  const RouteQuery query{{{laneIndex(*map, "ramp"), 0.0}}, {}, {{laneIndex(*map, "road"), 12.0}}, {}};
  EXPECT_THROW(router.findRoute(query, CancelToken()), NoRoute) << "over 13.5 m sideways";
  const RouteQuery further{{{laneIndex(*map, "ramp"), 70.0}}, {}, {{laneIndex(*map, "road"), 80.0}}, {}};
  EXPECT_TRUE(router.findRoute(further, CancelToken()).warnings.empty()) << "over 3.5 m";
}

}  // namespace
}  // namespace external_command
