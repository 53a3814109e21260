// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/router.h"

#include <gtest/gtest.h>

#include "support/map_builder.h"
#include "support/route_matchers.h"
#include "support/routing_world.h"

namespace external_command {
namespace {

///   a -----> b -----> c      a ring of 100 m per lane: c leads back to a, and a dead end d leads off b
///                \--> d
class Ring : public RoutingWorld {
 protected:
  Ring() {
    builder.lane("a", {0, 0}, {100, 0})
        .lane("b", {100, 0}, {100, 100})
        .lane("c", std::vector<Point2d>{{100, 100}, {50, 50}, {0, 0}})
        .lane("d", {100, 100}, {200, 100})
        .follow({"a", "b", "c", "a"})
        .follow({"b", "d"});
  }
};

TEST_F(Ring, DrivesAlongOneLane) {
  const Route route = drive({"a", 10}, {"a", 90});
  EXPECT_EQ(ids(route), "a");
  EXPECT_NEAR(route.distance, 80.0, 1e-9);
}

TEST_F(Ring, DrivesOntoTheSuccessors) {
  const Route route = drive({"a", 10}, {"d", 50});
  EXPECT_EQ(ids(route), "a b d");
  EXPECT_NEAR(route.distance, 90.0 + 100.0 + 50.0, 1e-9);
}

TEST_F(Ring, StaysWhereTheGoalIsTheStart) {
  const Route route = drive({"a", 10}, {"a", 10});
  EXPECT_EQ(ids(route), "a");
  EXPECT_EQ(route.distance, 0.0);
}

TEST_F(Ring, TakesAGoalUpToTheStoppingErrorBehindTheStartAsReached) {
  for (const double behind : {0.001, 0.3, 0.5}) {
    const Route route = drive({"a", 60}, {"a", 60 - behind});
    EXPECT_EQ(ids(route), "a");
    EXPECT_EQ(route.distance, 0.0) << behind << " m behind";
  }
  EXPECT_EQ(ids(drive({"a", 60}, {"a", 59.4})), "a b c a");
  params.stopping_error = 0.0;
  EXPECT_EQ(ids(drive({"a", 60}, {"a", 59.9})), "a b c a");
}

TEST_F(Ring, TakesAGoalJustBehindTheStartOnTheLaneBeforeAsReached) {
  EXPECT_EQ(search({{point("b", 0.2)}, {}, {point("a", 99.8)}, {}}).distance, 0.0);
  EXPECT_NEAR(drive({"b", 0.3}, {"a", 99.7}).distance, 99.7 + 100.0 * std::sqrt(2.0) + 99.7, 1e-9);
}

TEST_F(Ring, TakesAWayPointJustBehindTheOneBeforeAsReached) {
  const Route route = drive({"a", 10}, {{{"a", 40}}, {{"a", 39.999}}}, {"a", 70});
  EXPECT_EQ(ids(route), "a");
  EXPECT_NEAR(route.distance, 60.0, 1e-9);
}

TEST_F(Ring, TakesWayPointsThatLieEachJustBehindTheOneBeforeAsReached) {
  const Route route = drive({"a", 10}, {{{"a", 40}}, {{"a", 39.6}}, {{"a", 39.2}}, {{"a", 38.8}}}, {"a", 70});
  EXPECT_EQ(ids(route), "a");
  EXPECT_NEAR(route.distance, 60.0, 1e-9);
  EXPECT_EQ(ids(drive({"a", 10}, {{{"a", 40}}, {{"a", 39.6}}, {{"a", 39.0}}}, {"a", 70})), "a b c a");
  EXPECT_NEAR(drive({"a", 10}, {{{"b", 0.2}}, {{"a", 99.8}}, {{"a", 99.4}}}, {"b", 50}).distance, 140.0, 1e-9);
}

TEST_F(Ring, WarnsWhereTheGoalAfterSuchWayPointsLiesBehindTheEnd) {
  const RouteQuery near{{point("a", 10)}, {{point("a", 40)}}, {point("a", 39.6)}, {}};
  EXPECT_TRUE(router().findRoute(near, CancelToken()).warnings.empty());
  const RouteQuery far{{point("a", 10)}, {{point("a", 40)}, {point("a", 39.6)}}, {point("a", 39.2)}, {}};
  const Route route = router().findRoute(far, CancelToken());
  EXPECT_NEAR(route.distance, 30.0, 1e-9);
  ASSERT_EQ(route.warnings.size(), 1u);
  EXPECT_NE(route.warnings[0].find("ends 0.80 m beyond its goal"), std::string::npos) << route.warnings[0];
}

TEST_F(Ring, DoesNotTakeAGoalBehindTheStartAsReachedWhereTheBlackListCoversIt) {
  EXPECT_THAT_REFUSED(drive({"a", 60}, {}, {"a", 59.8}, {{"a", 59.7, 59.9}}), NoRoute, "covers the goal");
}

TEST_F(Ring, DrivesALoopToAGoalBehindTheStart) {
  const Route route = drive({"a", 60}, {"a", 40});
  EXPECT_EQ(ids(route), "a b c a");
  EXPECT_NEAR(route.distance, 40.0 + 100.0 + 100.0 * std::sqrt(2.0) + 40.0, 1e-9);
}

TEST_F(Ring, TakesAGoalLessThanAMillimetreBehindTheStartAsReached) {
  EXPECT_NEAR(drive({"a", 60.0005}, {"a", 60}).distance, 0.0, 1e-3);
}

TEST_F(Ring, RefusesAGoalBehindTheStartWithoutALoop) {
  EXPECT_THAT_REFUSED(drive({"d", 60}, {"d", 40}), NoRoute,
                      "no route from start (lane d at 60.00 m) to goal (lane d at 40.00 m)");
}

TEST_F(Ring, SaysHowManyLanesWereReached) {
  EXPECT_THAT_REFUSED(drive({"d", 60}, {"a", 0}), NoRoute, "1 lanes of 4 were reached");
}

TEST_F(Ring, SaysWhichLinkIsMissing) {
  builder["a"].successors.clear();
  EXPECT_THAT_REFUSED(drive({"a", 10}, {"c", 50}), NoRoute,
                      "lane a ends where lane b begins, 0.00 m apart, but the map does not link them");
  builder["b"].successors = {"d"};
  EXPECT_THAT_REFUSED(drive({"a", 10}, {"c", 50}), NoRoute, "lane a ends where lane b begins");
}

TEST_F(Ring, SaysWhichLinkHasTooLargeAGap) {
  for (Point2d& point : builder["d"].center) point.x() += 14.0;
  EXPECT_THAT_REFUSED(drive({"a", 10}, {"d", 50}), NoRoute,
                      "the link from lane b to lane d is not driven, its ends lie 14.00 m apart (~map/max_link_gap)");
}

TEST_F(Ring, SaysNothingOfLinksThatWouldNotHelp) {
  try {
    drive({"d", 60}, {"d", 40});
    ADD_FAILURE();
  } catch (const NoRoute& refused) {
    EXPECT_EQ(std::string(refused.what()).find("but the map"), std::string::npos) << refused.what();
  }
}

TEST_F(Ring, PassesWayPointsInOrder) {
  const Route route = drive({"a", 10}, {{{"c", 20}}, {{"b", 20}}}, {"c", 30});
  EXPECT_EQ(ids(route), "a b c a b c");
}

TEST_F(Ring, PassesAWayPointAtTheStart) {
  EXPECT_NEAR(drive({"a", 10}, {{{"a", 10}}}, {"a", 30}).distance, 20.0, 1e-9);
}

TEST_F(Ring, NamesTheLegThatCannotBeDriven) {
  EXPECT_THAT_REFUSED(drive({"a", 10}, {{{"b", 20}}, {{"d", 20}}}, {"a", 30}), NoRoute,
                      "from way_point[1] (lane d at 20.00 m) to goal (lane a at 30.00 m)");
}

TEST_F(Ring, TakesTheStartAndTheGoalWithTheShortestRoute) {
  const Route route = search({{point("a", 10), point("b", 50)}, {}, {point("c", 100), point("d", 70)}, {}});
  EXPECT_EQ(route.start, 1u);
  EXPECT_EQ(route.goal, 1u);
  EXPECT_NEAR(route.distance, 50.0 + 70.0, 1e-9);
}

TEST_F(Ring, WeighsThePriceOfEachCandidate) {
  const std::vector<LanePoint> goals = {point("c", 10), point("d", 20)};
  const auto search_with = [&](double price) {
    RouteQuery query{{point("a", 10), point("b", 50)}, {{point("b", 60)}}, goals, {}};
    query.starts[1].price = price;
    query.goals[0].price = 15.0;
    return search(query);
  };
  const Route near = search_with(20.0), far = search_with(200.0);
  EXPECT_EQ(near.start, 1u);
  EXPECT_EQ(far.start, 0u);
  EXPECT_EQ(near.goal, 1u) << "10 m further, but without a price";
  EXPECT_EQ(near.via, std::vector<std::size_t>{0});
  EXPECT_NEAR(near.distance, 10.0 + 40.0 + 20.0, 1e-9);
  EXPECT_NEAR(near.cost, near.distance + 20.0, 1e-9);
}

TEST_F(Ring, TakesTheWayPointThatIsBestForTheWholeRouteNotForItsLeg) {
  // The nearer candidate lies on the dead end.
  EXPECT_EQ(ids(drive({"b", 10}, {{{"d", 1}, {"c", 10}}}, {"a", 20})), "b c a");
}

TEST_F(Ring, ChecksTheRequest) {
  EXPECT_THAT_REFUSED(search({{}, {}, {point("a", 1)}, {}}), InvalidRequest, "the route has no start");
  EXPECT_THAT_REFUSED(search({{point("a", 1)}, {}, {}, {}}), InvalidRequest, "the route has no goal");
  EXPECT_THAT_REFUSED(search({{point("a", 1)}, {{}}, {point("a", 1)}, {}}), InvalidRequest, "no way_point[0]");
  EXPECT_THAT_REFUSED(drive({"a", -0.1}, {"b", 1}), InvalidRequest, "start has s -0.1 on lane a");
  EXPECT_THAT_REFUSED(drive({"a", 1}, {"b", 100.1}), InvalidRequest, "goal has s 100.1 on lane b");
  EXPECT_THAT_REFUSED(drive({"a", NAN}, {"b", 1}), InvalidRequest, "start has s nan");
  EXPECT_THAT_REFUSED(search({{{17, 1.0}}, {}, {point("a", 1)}, {}}), InvalidRequest, "the map has 4 lanes");
}

TEST_F(Ring, StopsWhenCancelled) {
  CancelSource source;
  source.cancel();
  EXPECT_THROW(router().findRoute({{point("a", 1)}, {}, {point("c", 1)}, {}}, source.token()), Cancelled);
}

TEST_F(Ring, DrivesOnlyWhatIsForDriving) {
  builder["c"].type = LaneType::kBiking;
  EXPECT_THAT_REFUSED(drive({"b", 1}, {"a", 1}), NoRoute, "no route");
  EXPECT_THAT_REFUSED(drive({"c", 1}, {"a", 1}), InvalidRequest, "lane c, which is not for driving");
}

TEST_F(Ring, DrivesLanesAlongTheirCentreLinesWhateverTheirDirectionSays) {
  for (const LaneDirection direction : {LaneDirection::kBidirection, LaneDirection::kBackward}) {
    builder["c"].direction = direction;
    EXPECT_EQ(ids(drive({"b", 1}, {"a", 1})), "b c a");
  }
}

TEST_F(Ring, GoesAroundNothingWhenTheBlackListCutsTheOnlyWay) {
  EXPECT_THAT_REFUSED(drive({"a", 10}, {}, {"c", 50}, {{"b", 40, 60}}), NoRoute,
                      "the black list cuts it at lane b; without the black list there is a route");
  EXPECT_EQ(ids(drive({"a", 10}, {}, {"c", 50}, {{"d", 0, 100}})), "a b c");
}

TEST_F(Ring, MayDriveUpToAndFromBehindABlackListedPart) {
  EXPECT_EQ(ids(drive({"a", 10}, {}, {"b", 39}, {{"b", 40, 60}})), "a b");
  EXPECT_EQ(ids(drive({"b", 61}, {}, {"a", 10}, {{"b", 40, 60}})), "b c a");
}

TEST_F(Ring, RefusesToStartOrEndOnABlackListedPart) {
  EXPECT_THAT_REFUSED(drive({"b", 40}, {}, {"c", 50}, {{"b", 40, 60}}), NoRoute, "the black list covers the start");
  EXPECT_THAT_REFUSED(drive({"a", 40}, {}, {"b", 60}, {{"b", 40, 60}}), NoRoute, "the black list covers the goal");
}

TEST_F(Ring, SkipsCandidatesOnABlackListedPart) {
  const Route route =
      search({{point("b", 50), point("a", 90)}, {}, {point("b", 45), point("b", 30)}, {range("b", 40, 55)}});
  EXPECT_EQ(route.start, 1u);
  EXPECT_EQ(route.goal, 1u);
  EXPECT_EQ(ids(route), "a b");
}

TEST_F(Ring, RefusesParametersOutOfRange) {
  params.min_lane_change_length = 0.0;
  EXPECT_THAT_REFUSED(Router(builder.build(), params), InvalidParameter, "min_lane_change_length is 0");
  EXPECT_THAT_REFUSED(Router(nullptr, RouterParams()), NotReady, "no map");
}

///         +-- up ----+
///   in ---+          +--- out      two ways of the same length
///         +-- down --+
TEST(EqualRoutes, AreDecidedTheSameEachTime) {
  MapBuilder builder;
  builder.lane("in", {-50, 0}, {0, 0}).lane("out", {100, 0}, {150, 0});
  builder.lane("up", std::vector<Point2d>{{0, 0}, {50, 30}, {100, 0}});
  builder.lane("down", std::vector<Point2d>{{0, 0}, {50, -30}, {100, 0}});
  builder.follow({"in", "up", "out"}).follow({"in", "down", "out"});
  const auto map = builder.build();
  const Router router(map, {});
  for (int i = 0; i < 20; ++i) {
    RouteQuery query{{{laneIndex(*map, "in"), 1.0}}, {}, {{laneIndex(*map, "out"), 1.0 + i}}, {}};
    EXPECT_EQ(laneIds(router.findRoute(query, CancelToken()), *map), "in up out") << "the first that the map names";
    query.goals.push_back(query.goals.front());
    EXPECT_EQ(router.findRoute(query, CancelToken()).goal, Router(map, {}).findRoute(query, CancelToken()).goal);
  }
}

}  // namespace
}  // namespace external_command
