// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/hd_map.h"

#include <gtest/gtest.h>

#include <limits>

#include "external_command/core/error.h"
#include "map/map_files.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

using Indices = std::vector<LaneIndex>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

///   left  ----> far_left          (two lanes side by side, going on; a third lane comes the other way)
///   right ----> far_right
class TwoLaneRoad : public ::testing::Test {
 protected:
  TwoLaneRoad() {
    builder.lane("left", {0, 3.5}, {100, 3.5}).lane("far_left", {100, 3.5}, {200, 3.5});
    builder.lane("right", {0, 0}, {100, 0}).lane("far_right", {100, 0}, {200, 0});
    builder.lane("oncoming", {100, 7}, {0, 7});
    builder.follow({"left", "far_left"}).follow({"right", "far_right"});
    builder.beside({"left", "right"}).beside({"far_left", "far_right"}).opposite("left", "oncoming");
    builder.road("main", {"left", "right"}).road("side", {"far_left", "far_right"}, "crossing");
  }

  MapBuilder builder;
};

TEST_F(TwoLaneRoad, ResolvesEveryReference) {
  const auto map = builder.build();
  const LaneIndex left = laneIndex(*map, "left"), right = laneIndex(*map, "right");
  EXPECT_EQ(map->lane(left).successors, Indices{laneIndex(*map, "far_left")});
  EXPECT_EQ(map->lane(laneIndex(*map, "far_left")).predecessors, Indices{left});
  EXPECT_EQ(map->lane(left).right_forward, Indices{right});
  EXPECT_EQ(map->lane(right).left_forward, Indices{left});
  EXPECT_EQ(map->lane(left).left_reverse, Indices{laneIndex(*map, "oncoming")});
  EXPECT_TRUE(map->lane(left).left_forward.empty());
  EXPECT_TRUE(map->warnings().empty()) << map->warnings()[0].what;
}

TEST_F(TwoLaneRoad, FindsLanesAndRoadsByTheirIds) {
  const auto map = builder.build();
  EXPECT_EQ(map->lane(*map->findLane("right")).id, "right");
  EXPECT_FALSE(map->findLane("nowhere"));
  EXPECT_TRUE(map->hasRoad("main"));
  EXPECT_FALSE(map->hasRoad("nowhere"));
  EXPECT_EQ(map->lanesOfRoad("main"), (Indices{laneIndex(*map, "left"), laneIndex(*map, "right")}));
  EXPECT_TRUE(map->lanesOfRoad("nowhere").empty());
  EXPECT_EQ(map->lane(laneIndex(*map, "left")).road_id, "main");
  EXPECT_EQ(map->lane(laneIndex(*map, "oncoming")).road_id, "");
}

TEST_F(TwoLaneRoad, TakesTheJunctionOfTheRoadWhereTheLaneNamesNone) {
  builder["far_left"].junction = "own";
  const auto map = builder.build();
  EXPECT_EQ(map->lane(laneIndex(*map, "far_right")).junction_id, "crossing");
  EXPECT_EQ(map->lane(laneIndex(*map, "far_left")).junction_id, "own");
  EXPECT_EQ(map->lane(laneIndex(*map, "left")).junction_id, "");
}

TEST_F(TwoLaneRoad, PassesOverReferencesThatDangleAndCountsThem) {
  builder["left"].successors.push_back("ghost");
  builder["right"].left_forward.push_back("phantom");
  builder.road("haunted", {"spook"});
  const auto map = builder.build();
  EXPECT_EQ(map->lane(laneIndex(*map, "left")).successors.size(), 1u);
  EXPECT_TRUE(map->hasRoad("haunted"));
  EXPECT_TRUE(warnsOf(map->warnings(), 3, "references to lanes that do not exist, e.g. successor ghost of left"));
}

TEST_F(TwoLaneRoad, DropsReferencesToALaneThatIsDropped) {
  builder["far_left"].center = {{100, 3.5}};
  const auto map = builder.build();
  EXPECT_FALSE(map->findLane("far_left"));
  EXPECT_TRUE(map->lane(laneIndex(*map, "left")).successors.empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "lanes dropped that cannot be used, e.g. far_left"));
  EXPECT_TRUE(warnsOf(map->warnings(), 3, "references to lanes"));
}

TEST_F(TwoLaneRoad, DropsLanesWithCoordinatesThatAreNoPlaceOnEarth) {
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 1e200, -1e9}) {
    builder["far_right"].center[3].y() = bad;
    const auto map = builder.build();
    EXPECT_FALSE(map->findLane("far_right")) << bad;
    EXPECT_TRUE(warnsOf(map->warnings(), 1, "far_right: point 3 of the centre line is (")) << bad;
    EXPECT_LT(map->box().max.norm(), 1e4);
  }
}

TEST_F(TwoLaneRoad, DropsALaneWhoseCentreLineLeapsFurtherThanAnyRoadIsStraight) {
  builder["far_right"].center.back() += Point2d(1e7, 0.0);
  const auto map = builder.build();
  EXPECT_FALSE(map->findLane("far_right"));
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "from the one before it; the limit is 10000.00 m"));
  EXPECT_LT(map->box().max.norm(), 1e4);
}

TEST_F(TwoLaneRoad, DropsLanesWithSegmentsLongerThanTheParameterSays) {
  builder["far_right"].center = {builder["far_right"].center.front(), builder["far_right"].center.back()};
  MapParams params;
  params.max_segment_length = 50.0;
  const HdMap map(builder.data(), Point2d::Zero(), params);
  EXPECT_FALSE(map.findLane("far_right"));
  EXPECT_TRUE(map.findLane("right"));
  EXPECT_TRUE(warnsOf(map.warnings(), 1, "the limit is 50.00 m (~map/max_segment_length)"));
}

TEST_F(TwoLaneRoad, KeepsALaneThatIsStraightForKilometres) {
  builder["far_right"].center.back() += Point2d(9000.0, 0.0);
  EXPECT_TRUE(builder.build()->findLane("far_right"));
}

TEST_F(TwoLaneRoad, KeepsTheFirstOfTwoLanesWithOneId) {
  builder.lane("left", {500, 500}, {600, 500});
  const auto map = builder.build();
  EXPECT_EQ(map->lanes().size(), 5u);
  EXPECT_EQ(map->lane(laneIndex(*map, "left")).center.points().front(), Point2d(0, 3.5));
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "lanes dropped whose id an earlier lane has, e.g. left"));
}

TEST_F(TwoLaneRoad, DropsLanesWithoutAnId) {
  builder.lane("", {500, 500}, {600, 500});
  EXPECT_TRUE(warnsOf(builder.build()->warnings(), 1, "a lane without an id"));
}

TEST_F(TwoLaneRoad, MeasuresLanesWhoseStatedLengthIsWrong) {
  builder["left"].length = 120.0;
  builder["right"].length = 0.0;
  const auto map = builder.build();
  EXPECT_NEAR(map->lane(laneIndex(*map, "left")).length(), 100.0, 1e-9);
  EXPECT_TRUE(warnsOf(map->warnings(), 2, "left: 120.00 m stated, 100.00 m measured"));
}

TEST_F(TwoLaneRoad, DropsBoundariesWidthsAndSpeedLimitsThatCannotBe) {
  builder["left"].left.points[1].x() = kNan;
  builder["left"].left_widths[0].width = -1.0;
  builder["left"].speed_limit = kNan;
  builder["right"].speed_limit = -3.0;
  const auto map = builder.build();
  const Lane& left = map->lane(laneIndex(*map, "left"));
  EXPECT_TRUE(left.left.points.empty());
  EXPECT_EQ(left.left_widths.size(), 1u);
  EXPECT_EQ(left.speed_limit, 0.0);
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "lane boundaries dropped"));
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "width samples dropped"));
  EXPECT_TRUE(warnsOf(map->warnings(), 2, "speed limits dropped"));
}

TEST_F(TwoLaneRoad, LetsTheFirstOfTwoRoadsHaveALane) {
  builder.road("thief", {"left"});
  const auto map = builder.build();
  EXPECT_EQ(map->lane(laneIndex(*map, "left")).road_id, "main");
  EXPECT_TRUE(map->lanesOfRoad("thief").empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "left: main and thief"));
}

TEST_F(TwoLaneRoad, DerivesTheLinksThatNoLaneStates) {
  const auto stated = builder.build();
  for (LaneData& lane : builder.data().lanes) lane.predecessors.clear();
  const auto forward_only = builder.build();
  for (std::size_t i = 0; i < stated->lanes().size(); ++i) {
    EXPECT_EQ(forward_only->lanes()[i].predecessors, stated->lanes()[i].predecessors);
  }
  EXPECT_TRUE(forward_only->warnings().empty());
}

TEST_F(TwoLaneRoad, DerivesSuccessorsWhereOnlyPredecessorsAreStated) {
  const auto stated = builder.build();
  for (LaneData& lane : builder.data().lanes) lane.successors.clear();
  const auto backward_only = builder.build();
  for (std::size_t i = 0; i < stated->lanes().size(); ++i) {
    EXPECT_EQ(backward_only->lanes()[i].successors, stated->lanes()[i].successors);
  }
  EXPECT_TRUE(warnsOf(backward_only->warnings(), 2, "linked backwards only"));
}

TEST_F(TwoLaneRoad, LeavesLinksAloneWhereTheFileStatesSome) {
  builder["left"].successors.clear();
  const auto map = builder.build();
  EXPECT_TRUE(map->lane(laneIndex(*map, "left")).successors.empty());
  EXPECT_EQ(map->lane(laneIndex(*map, "far_left")).predecessors.size(), 1u);
}

TEST_F(TwoLaneRoad, InventsNoNeighboursAndSaysSo) {
  for (LaneData& lane : builder.data().lanes) lane.left_forward = lane.right_forward = {};
  const auto map = builder.build();
  for (const Lane& lane : map->lanes()) EXPECT_TRUE(lane.left_forward.empty() && lane.right_forward.empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 4, "with another beside them")) << "all but the oncoming one";
}

TEST_F(TwoLaneRoad, LetsALaneLeadIntoItselfButNotLieBesideItself) {
  builder.lane("ring", {{0, 50}, {50, 50}, {50, 80}, {0, 80}, {0, 50}}).follow({"ring", "ring"});
  builder["ring"].left_forward.push_back("ring");
  const auto map = builder.build();
  const LaneIndex ring = laneIndex(*map, "ring");
  EXPECT_EQ(map->lane(ring).successors, Indices{ring});
  EXPECT_TRUE(map->lane(ring).left_forward.empty());
}

TEST_F(TwoLaneRoad, SubtractsTheOriginFromEverything) {
  builder.junction("crossing", {{100, 0}, {200, 0}, {200, 10}});
  builder.parkingSpace("p", {50, -5, 0}, 5, 2.5).area("a", {{0, 0}, {10, 0}, {10, 10}});
  const Point2d origin(1000.5, -2000.25);
  const auto plain = builder.build(), shifted = builder.build(origin);
  EXPECT_EQ(shifted->origin(), origin);
  EXPECT_TRUE(shifted->box().min.isApprox(plain->box().min - origin));
  EXPECT_TRUE(shifted->box().max.isApprox(plain->box().max - origin));
  EXPECT_EQ(shifted->lanes()[0].center.points()[2], plain->lanes()[0].center.points()[2] - origin);
  EXPECT_EQ(shifted->lanes()[0].left.points[2], plain->lanes()[0].left.points[2] - origin);
  EXPECT_EQ(shifted->junctions()[0].polygon.points()[1], plain->junctions()[0].polygon.points()[1] - origin);
  EXPECT_EQ(shifted->parkingSpaces()[0].polygon.points()[1], plain->parkingSpaces()[0].polygon.points()[1] - origin);
  EXPECT_EQ(shifted->areas()[0].polygon.points()[1], plain->areas()[0].polygon.points()[1] - origin);
  EXPECT_EQ(shifted->nearestLane(Point2d(50, 0) - origin, {})->lane, laneIndex(*shifted, "right"));
}

TEST_F(TwoLaneRoad, IsBoundedByEverythingInIt) {
  builder.area("far", {{300, 300}, {310, 300}, {310, 320}});
  const BoundingBox box = builder.build()->box();
  EXPECT_NEAR((box.min - Point2d(0, -MapBuilder::kLaneWidth / 2.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((box.max - Point2d(310, 320)).norm(), 0.0, 1e-9);
}

TEST(HdMap, RefusesAMapWithoutALane) {
  EXPECT_THROW(MapBuilder().build(), MapError);
  MapBuilder builder;
  builder.lane("point", {{1, 1}, {1, 1}});
  try {
    builder.build();
    FAIL();
  } catch (const MapError& error) {
    EXPECT_NE(std::string(error.what()).find("none of the map's 1 lanes can be used"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("point: the centre line has 1 distinct points"), std::string::npos);
  }
}

TEST(HdMap, RefusesAnOriginThatIsNotFinite) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {10, 0});
  EXPECT_THROW(builder.build({kNan, 0}), MapError);
}

TEST(LaneWidth, ComesFromSamplesElseFromBoundariesElseIsUsual) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {100, 0});
  builder["a"].left_widths = {{0, 1.0}, {50, 2.0}, {100, 2.0}};
  builder["a"].right_widths = {{10, 3.0}};
  EXPECT_NEAR(builder.build()->lanes()[0].widthAt(25), 1.5 + 3.0, 1e-9);
  EXPECT_NEAR(builder.build()->lanes()[0].widthAt(-5), 1.0 + 3.0, 1e-9);
  EXPECT_NEAR(builder.build()->lanes()[0].widthAt(500), 2.0 + 3.0, 1e-9);
  builder["a"].right_widths.clear();
  EXPECT_NEAR(builder.build()->lanes()[0].widthAt(75), 2.0 + 1.75, 1e-9);
  builder["a"].left_widths.clear();
  builder["a"].left.points = builder["a"].right.points = {};
  EXPECT_NEAR(builder.build()->lanes()[0].widthAt(75), 3.5, 1e-9);
}

TEST(LaneTypes, OnlyDrivingAndSharedLanesAreDrivable) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {10, 0});
  const auto isDrivable = [&](LaneType type) {
    builder["a"].type = type;
    return builder.build()->lanes()[0].isDrivable();
  };
  EXPECT_TRUE(isDrivable(LaneType::kCityDriving));
  EXPECT_TRUE(isDrivable(LaneType::kShared));
  for (const LaneType type :
       {LaneType::kNone, LaneType::kBiking, LaneType::kSidewalk, LaneType::kParking, LaneType::kShoulder}) {
    EXPECT_FALSE(isDrivable(type));
  }
}

}  // namespace
}  // namespace external_command
