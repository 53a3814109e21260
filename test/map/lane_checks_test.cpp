// SPDX-License-Identifier: Apache-2.0
// What is put right, dropped, or only counted, about the links, neighbours and directions of lanes.
#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/error.h"
#include "external_command/map/hd_map.h"
#include "map/map_files.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

constexpr double kWidth = MapBuilder::kLaneWidth;
using Indices = std::vector<LaneIndex>;

///   a ----> b ----> c      100 m each
class ThreeInARow : public testing::Test {
 protected:
  ThreeInARow() {
    builder.lane("a", {0, 0}, {100, 0}).lane("b", {100, 0}, {200, 0}).lane("c", {200, 0}, {300, 0});
    builder.follow({"a", "b", "c"});
  }

  void move(const char* lane, double dx, double dy) {
    for (Point2d& point : builder[lane].center) point += Point2d(dx, dy);
  }

  const Lane& lane(const std::string& id) { return map->lane(laneIndex(*map, id)); }

  void build(const MapParams& params = {}) {
    map = std::make_shared<const HdMap>(builder.data(), Point2d::Zero(), params);
  }

  MapBuilder builder;
  std::shared_ptr<const HdMap> map;
};

TEST_F(ThreeInARow, KeepTheLinksOfALaneOfNoLength) {
  for (const double length : {0.0, 0.0009}) {
    builder["b"].center = {{100, 0}, {100 + length, 0}};
    builder["c"].center.front() = {100, 0};
    build();
    EXPECT_EQ(lane("a").successors, Indices{laneIndex(*map, "b")});
    EXPECT_EQ(lane("b").successors, Indices{laneIndex(*map, "c")});
    EXPECT_LT(lane("b").length(), 0.002);
    EXPECT_NEAR(lane("b").center.headingAt(0.0), 0.0, 1e-9) << "as the lane before it";
    EXPECT_TRUE(warnsOf(map->warnings(), 1, "lanes of no length, which keep their links, e.g. b"));
    EXPECT_FALSE(warnsOf(map->warnings(), 1, "references"));
  }
}

TEST_F(ThreeInARow, AreNotLinkedOverAGapThatIsTooLarge) {
  move("b", 1.9, 0.0);
  move("c", 16.0, 0.0);
  build();
  EXPECT_EQ(lane("a").successors.size(), 1u);
  EXPECT_TRUE(lane("b").successors.empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "links whose ends do not meet, the worst: a to b, 1.90 m"));
  EXPECT_TRUE(warnsOf(map->warnings(), 1,
                      "links that are not driven, as their ends lie too far apart "
                      "(map/max_link_gap), the worst: b to c, 14.10 m"));
  ASSERT_EQ(map->brokenLinks().size(), 1u);
  EXPECT_NEAR(map->brokenLinks()[0].gap, 14.1, 1e-9);
  build({20.0});
  EXPECT_EQ(lane("b").successors.size(), 1u);
}

TEST_F(ThreeInARow, AreLinkedWithoutAWordWhereTheEndsNearlyMeet) {
  move("b", 0.0, 0.25);
  build();
  EXPECT_FALSE(warnsOf(map->warnings(), 1, "links"));
}

TEST_F(ThreeInARow, AreEnteredWhereTheOneBeforeEndsWhereTheyOverlap) {
  move("b", -3.0, 0.1);
  move("c", -3.0, 0.1);
  build();
  EXPECT_EQ(lane("a").entries, std::vector<double>{3.0});
  EXPECT_EQ(lane("b").entries, std::vector<double>{0.0});
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "linked lanes that overlap, the worst: a and b, by 3.00 m"));
}

TEST_F(ThreeInARow, HaveFoldsAndKinksCounted) {
  builder["b"].center.insert(builder["b"].center.begin() + 10, {{148, 0}, {141, 0}});
  builder["c"].center = {{200, 0}, {200, 100}};
  build();
  EXPECT_TRUE(warnsOf(map->warnings(), 2, "folds back on itself, the worst: b at (141.00, 0.00), by 7.00 m"));
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "links at which the heading jumps, the worst: b to c, by 1.57"));
}

TEST(MapParams, RefuseValuesOutOfRange) {
  EXPECT_NO_THROW(MapParams().validate());
  EXPECT_THROW(MapParams{-1.0}.validate(), InvalidParameter);
  EXPECT_THROW((MapParams{2.0, 0.0}.validate()), InvalidParameter);
  EXPECT_THROW((MapParams{2.0, std::nan("")}.validate()), InvalidParameter);
}

///   left  ---->
///   right ---->      oncoming <---- beyond
class SideBySide : public testing::Test {
 protected:
  SideBySide() {
    builder.lane("left", {0, kWidth}, {100, kWidth}).lane("right", {0, 0}, {100, 0});
    builder.lane("oncoming", {100, 2 * kWidth}, {0, 2 * kWidth}).lane("far", {0, 50}, {100, 50});
  }

  MapBuilder builder;
};

TEST_F(SideBySide, AreNeighboursWhereTheyLie) {
  builder["left"].left_forward = {"right"};
  builder["right"].left_forward = {"left"};
  const auto map = builder.build();
  EXPECT_TRUE(map->lane(laneIndex(*map, "left")).left_forward.empty());
  EXPECT_EQ(map->lane(laneIndex(*map, "left")).right_forward, Indices{laneIndex(*map, "right")});
  EXPECT_EQ(map->lane(laneIndex(*map, "right")).left_forward, Indices{laneIndex(*map, "left")});
  EXPECT_TRUE(warnsOf(map->warnings(), 1,
                      "neighbours on the other side than the map states; they count where they "
                      "lie, e.g. right, stated as the left neighbour of left"));
}

TEST_F(SideBySide, AreNoNeighboursForALaneChangeWhereTheyRunTheOtherWayOrFarOff) {
  builder["left"].left_forward = {"oncoming", "far"};
  const auto map = builder.build();
  EXPECT_TRUE(map->lane(laneIndex(*map, "left")).left_forward.empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 1,
                      "forward neighbours that run the other way; no lane changes to them, e.g. "
                      "oncoming of left"));
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "too far off for a lane change, the worst: far of left, 46.50 m off"));
}

///   in ----> both <====> end ====     `both` and `end` may be driven either way
///            \___ out <---
class BothWays : public testing::Test {
 protected:
  BothWays() {
    builder.lane("in", {0, 0}, {100, 0}).lane("both", {100, 0}, {200, 0}).lane("end", {200, 0}, {300, 0});
    builder.lane("out", {100, 0}, {0, 0.5}).follow({"in", "both", "end"});
    builder["both"].predecessors.push_back("out");  // which begins where `both` does
    builder["both"].direction = builder["end"].direction = LaneDirection::kBidirection;
  }

  MapBuilder builder;
};

TEST_F(BothWays, AreLanesOfTheirOwnInEitherDirection) {
  builder["both"].left.types = {{0.0, BoundaryType::kDottedWhite}, {30.0, BoundaryType::kCurb}};
  builder["both"].left_widths = {{0.0, 1.0}, {100.0, 3.0}};
  const auto map = builder.build();
  ASSERT_EQ(map->lanes().size(), 6u);
  const LaneIndex forward = laneIndex(*map, "both");
  const Lane& back = map->lane(*map->lane(forward).reverse);
  EXPECT_EQ(back.id, "both");
  EXPECT_TRUE(back.is_reversed);
  EXPECT_EQ(back.reverse, forward);
  EXPECT_EQ(back.center.points().front(), Point2d(200, 0));
  EXPECT_EQ(back.statedS(30.0), 70.0);
  ASSERT_EQ(back.right.types.size(), 2u);
  EXPECT_EQ(back.right.types[0].type, BoundaryType::kCurb);
  EXPECT_EQ(back.right.types[1].type, BoundaryType::kDottedWhite);
  EXPECT_NEAR(back.right.types[1].s, 70.0, 1e-9);
  EXPECT_NEAR(back.right_widths.front().width, 3.0, 1e-9);
}

TEST_F(BothWays, AreLinkedWhereTheirEndsMeet) {
  const auto map = builder.build();
  const LaneIndex both_back = *map->lane(laneIndex(*map, "both")).reverse;
  const LaneIndex end_back = *map->lane(laneIndex(*map, "end")).reverse;
  EXPECT_EQ(map->lane(end_back).successors, Indices{both_back});
  EXPECT_EQ(map->lane(both_back).successors, Indices{laneIndex(*map, "out")});
  EXPECT_EQ(map->lane(laneIndex(*map, "end")).successors, Indices()) << "there is nowhere to turn round";
  EXPECT_TRUE(map->brokenLinks().empty());
}

TEST_F(BothWays, AreNeighboursOfTheLanesOfEachDirection) {
  builder.lane("north", {200, kWidth}, {100, kWidth}).opposite("both", "north");
  const auto map = builder.build();
  const LaneIndex both_back = *map->lane(laneIndex(*map, "both")).reverse, north = laneIndex(*map, "north");
  EXPECT_EQ(map->lane(both_back).right_forward, Indices{north});
  EXPECT_EQ(map->lane(north).left_forward, Indices{both_back});
}

TEST_F(BothWays, AreBothParkedFrom) {
  builder.parkingSpace("P1", {130, -5, M_PI / 2}, 5.0, 2.5, {"both"});
  const auto map = builder.build();
  EXPECT_EQ(map->findParkingSpace("P1")->lanes.size(), 2u);
}

}  // namespace
}  // namespace external_command
