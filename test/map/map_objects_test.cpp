// SPDX-License-Identifier: Apache-2.0
// Junctions, parking spaces and areas of an HdMap, and the overlaps between them and lanes.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "external_command/core/error.h"
#include "external_command/map/hd_map.h"
#include "map/map_files.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

/// A lane along the x axis; parking spaces go below it (to the right of the lane).
class LaneAlongX : public ::testing::Test {
 protected:
  LaneAlongX() { builder.lane("lane", {0, 0}, {100, 0}).lane("other", {0, 50}, {100, 50}).beside({"lane", "other"}); }

  /// Heading of a space of this shape and place, stated as `stated` or not at all.
  double headingOf(const Pose2d& middle, double length, double width, std::optional<double> stated) {
    builder.data().parking_spaces.clear();
    builder.parkingSpace("p", middle, length, width);
    builder.data().parking_spaces[0].has_heading = stated.has_value();
    builder.data().parking_spaces[0].heading = stated.value_or(0.0);
    return builder.build()->parkingSpaces()[0].heading;
  }

  MapBuilder builder;
};

TEST_F(LaneAlongX, FindsParkingSpacesAndAreasByTheirIds) {
  builder.parkingSpace("p", {50, -6, -M_PI / 2}, 5, 2.5, {"lane"}).area("a", {{0, 0}, {9, 0}, {9, 9}}, "yard");
  const auto map = builder.build();
  ASSERT_NE(map->findParkingSpace("p"), nullptr);
  EXPECT_EQ(map->findParkingSpace("p")->id, "p");
  EXPECT_NEAR(map->findParkingSpace("p")->polygon.area(), 12.5, 1e-9);
  EXPECT_EQ(map->findParkingSpace("q"), nullptr);
  ASSERT_NE(map->findArea("a"), nullptr);
  EXPECT_EQ(map->findArea("a")->name, "yard");
  EXPECT_EQ(map->findArea("b"), nullptr);
}

TEST_F(LaneAlongX, FindsTheFirstAreaAroundAPoint) {
  builder.area("small", {{0, 0}, {10, 0}, {10, 10}, {0, 10}}).area("large", {{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  const auto map = builder.build();
  EXPECT_EQ(map->areaAt({5, 5})->id, "small");
  EXPECT_EQ(map->areaAt({15, 5})->id, "large");
  EXPECT_EQ(map->areaAt({25, 5}), nullptr);
}

TEST_F(LaneAlongX, KnowsTheLanesThatOverlapASpace) {
  builder.parkingSpace("p", {50, -6, -M_PI / 2}, 5, 2.5, {"lane"});
  builder.data().overlaps[0].objects[0].start_s = 40;
  builder.data().overlaps[0].objects[0].end_s = 600;
  const auto map = builder.build();
  const std::vector<LaneOverlap>& lanes = map->findParkingSpace("p")->lanes;
  ASSERT_EQ(lanes.size(), 1u);
  EXPECT_EQ(lanes[0].lane, laneIndex(*map, "lane"));
  EXPECT_EQ(lanes[0].start_s, 40.0);
  EXPECT_EQ(lanes[0].end_s, 100.0);
}

TEST_F(LaneAlongX, FindsOverlapsThatOnlyTheOverlapItselfStates) {
  builder.parkingSpace("p", {50, -6, -M_PI / 2}, 5, 2.5, {"lane"});
  builder.data().parking_spaces[0].overlaps.clear();
  EXPECT_EQ(builder.build()->findParkingSpace("p")->lanes.size(), 1u);
}

TEST_F(LaneAlongX, CountsSpacesWithoutOverlapsAndOverlapsThatDangle) {
  builder.parkingSpace("p", {50, -6, -M_PI / 2}, 5, 2.5);
  builder.data().parking_spaces[0].overlaps = {"ghost"};
  const auto map = builder.build();
  EXPECT_TRUE(map->findParkingSpace("p")->lanes.empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "parking spaces that no lane overlaps"));
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "overlap ghost of p"));
}

TEST_F(LaneAlongX, PassesOverLanesOfOverlapsThatDangle) {
  builder.parkingSpace("p", {50, -6, -M_PI / 2}, 5, 2.5, {"lane"});
  builder.data().overlaps[0].objects[0].id = "ghost";
  const auto map = builder.build();
  EXPECT_TRUE(map->findParkingSpace("p")->lanes.empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 1, "lane ghost of overlap overlap_p_lane"));
}

TEST_F(LaneAlongX, TakesAllOfTheLaneWhereAnOverlapHasNoUsableRange) {
  builder.parkingSpace("p", {50, -6, -M_PI / 2}, 5, 2.5, {"lane"});
  for (const auto& [start, end] : {std::pair(60.0, 40.0), {std::numeric_limits<double>::quiet_NaN(), 3.0}}) {
    builder.data().overlaps[0].objects[0].start_s = start;
    builder.data().overlaps[0].objects[0].end_s = end;
    const auto map = builder.build();
    EXPECT_EQ(map->findParkingSpace("p")->lanes[0].start_s, 0.0);
    EXPECT_EQ(map->findParkingSpace("p")->lanes[0].end_s, 100.0);
    EXPECT_TRUE(warnsOf(map->warnings(), 1, "overlaps without a usable range"));
  }
}

/// One overlap of `lanes` lanes, which is named by each of `spaces` parking spaces.
MapData sharedOverlap(int lanes, int spaces) {
  MapBuilder builder;
  OverlapData overlap{"shared", {}};
  for (int i = 0; i < lanes; ++i) {
    builder.lane("lane_" + std::to_string(i), {{0, 4.0 * i}, {50, 4.0 * i}});
    overlap.objects.push_back({"lane_" + std::to_string(i), true, 0.0, 50.0});
  }
  for (int i = 0; i < spaces; ++i) {
    builder.parkingSpace("space_" + std::to_string(i), {3.0 * i, -6, M_PI / 2}, 5, 2.5);
    builder.data().parking_spaces.back().overlaps = {"shared"};
  }
  builder.data().overlaps = {overlap};
  return builder.data();
}

TEST(SharedOverlap, GivesEachOfManySpacesItsFewLanes) {
  const HdMap map(sharedOverlap(10, 20000), Point2d::Zero());
  for (const ParkingSpace& space : map.parkingSpaces()) EXPECT_EQ(space.lanes.size(), 10u) << space.id;
}

TEST(SharedOverlap, GivesOneSpaceItsManyLanes) {
  const HdMap map(sharedOverlap(20000, 1), Point2d::Zero());
  EXPECT_EQ(map.findParkingSpace("space_0")->lanes.size(), 20000u);
}

TEST(SharedOverlap, IsRefusedWhereManySpacesWouldHaveManyLanesEach) {
  try {
    HdMap(sharedOverlap(400, 400), Point2d::Zero());
    FAIL() << "it is taken";
  } catch (const MapError& error) {
    EXPECT_STREQ(error.what(),
                 "overlaps give parking spaces, areas and junctions more than 108000 lanes, which are 10 for each of "
                 "the 800 names in them and 100000 more; the one too many is of overlap shared with space_270; state "
                 "an overlap of its own for each lane with each object");
  }
}

TEST_F(LaneAlongX, TakesTheLanesOfAnOverlapWhereverTheyStandInIt) {
  builder.parkingSpace("p", {50, -6, -M_PI / 2}, 5, 2.5, {"lane"});
  builder.data().overlaps[0].objects = {{"p", false, 0, 0}, {"lane", true, 0, 9}, {"q", false, 0, 0}, {"other", true}};
  EXPECT_EQ(builder.build()->findParkingSpace("p")->lanes.size(), 2u);
}

TEST_F(LaneAlongX, DropsObjectsWhosePolygonCannotBeUsed) {
  builder.junction("j", {{0, 0}, {10, 10}, {10, 0}, {0, 10}}).area("a", {{0, 0}, {1, 0}});
  builder.parkingSpace("p", {50, -6, 0}, std::numeric_limits<double>::quiet_NaN(), 2.5);
  const auto map = builder.build();
  EXPECT_TRUE(map->junctions().empty());
  EXPECT_TRUE(map->areas().empty());
  EXPECT_TRUE(map->parkingSpaces().empty());
  EXPECT_TRUE(warnsOf(map->warnings(), 3, "map objects dropped whose polygon cannot be used, e.g. junction j crosses"));
}

TEST_F(LaneAlongX, DropsTheSecondOfTwoObjectsWithOneId) {
  builder.parkingSpace("p", {50, -6, 0}, 5, 2.5).parkingSpace("p", {60, -6, 0}, 5, 2.5).parkingSpace("", {}, 5, 2);
  builder.area("a", {{0, 0}, {9, 0}, {9, 9}}).area("a", {{0, 0}, {9, 0}, {9, 9}});
  const auto map = builder.build();
  EXPECT_EQ(map->parkingSpaces().size(), 1u);
  EXPECT_EQ(map->areas().size(), 1u);
  EXPECT_TRUE(warnsOf(map->warnings(), 3, "parking spaces and areas dropped"));
}

TEST_F(LaneAlongX, TakesTheJunctionThatCoversHalfOfALaneByTheOverlaps) {
  builder.junction("j", {{0, -5}, {60, -5}, {60, 5}, {0, 5}});
  builder.data().overlaps = {{"o", {{"lane", true, 0, 60}, {"other", true, 0, 40}, {"j", false, 0, 0}}}};
  const auto map = builder.build();
  EXPECT_EQ(map->lane(laneIndex(*map, "lane")).junction_id, "j");
  EXPECT_EQ(map->lane(laneIndex(*map, "other")).junction_id, "");
}

TEST_F(LaneAlongX, BelievesAHeadingAlongTheSpace) {
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, M_PI / 2), M_PI / 2, 1e-9);
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, -M_PI / 2), -M_PI / 2, 1e-9);
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, M_PI / 2 + 4 * M_PI), M_PI / 2, 1e-9);
  EXPECT_NEAR(headingOf({50, -6, 0}, 3, 3, 0.3), 0.3, 1e-9);
}

TEST_F(LaneAlongX, DerivesTheHeadingAwayFromTheLane) {
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, std::nullopt), -M_PI / 2, 1e-9);
  EXPECT_NEAR(headingOf({50, 6, -M_PI / 2}, 5, 2.5, std::nullopt), M_PI / 2, 1e-9);
  EXPECT_TRUE(warnsOf(builder.build()->warnings(), 1, "parking spaces without a heading"));
}

TEST_F(LaneAlongX, DerivesTheHeadingOfASpaceAlongTheLaneWithTheTraffic) {
  EXPECT_NEAR(headingOf({50, -3, M_PI}, 6, 2.5, std::nullopt), 0.0, 1e-9);
  EXPECT_NEAR(headingOf({50, 3, 0.2}, 6, 2.5, std::nullopt), 0.2, 1e-9);
}

TEST_F(LaneAlongX, DoesNotBelieveAHeadingAcrossTheSpace) {
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, 0.1), -M_PI / 2, 1e-9);
  EXPECT_TRUE(warnsOf(builder.build()->warnings(), 1, "heading lies across"));
}

TEST_F(LaneAlongX, TakesAHeadingOfMoreThanATurnForDegreesWhereThatFits) {
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, -90.0), -M_PI / 2, 1e-9);
  EXPECT_TRUE(warnsOf(builder.build()->warnings(), 1, "heading is in degrees, and was taken as such, e.g. p: -90"));
  EXPECT_NEAR(headingOf({50, -6, 0.6}, 5, 2.5, 0.6 / M_PI * 180.0), 0.6, 1e-9);
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, M_PI / 2 + 6 * M_PI), M_PI / 2, 1e-9)
      << "three turns and a quarter";
  EXPECT_NEAR(headingOf({50, -6, M_PI / 2}, 5, 2.5, 180.0), -M_PI / 2, 1e-9) << "across: derived";
  EXPECT_TRUE(warnsOf(builder.build()->warnings(), 1, "heading lies across"));
}

TEST_F(LaneAlongX, PutsTheCornersOfASpaceInOrder) {
  builder.parkingSpace("p", {50, -6, M_PI / 2}, 5, 2.5).parkingSpace("q", {60, -6, M_PI / 2}, 5, 2.5);
  std::swap(builder.data().parking_spaces[0].polygon[1], builder.data().parking_spaces[0].polygon[2]);
  std::swap(builder.data().parking_spaces[1].polygon[2], builder.data().parking_spaces[1].polygon[3]);
  const auto map = builder.build();
  ASSERT_EQ(map->parkingSpaces().size(), 2u);
  for (const ParkingSpace& space : map->parkingSpaces()) EXPECT_NEAR(space.polygon.area(), 12.5, 1e-9);
  EXPECT_TRUE(warnsOf(map->warnings(), 2, "parking spaces whose corners are in crossed order"));
}

TEST_F(LaneAlongX, TellsWhyASpaceCannotBeUsed) {
  builder.parkingSpace("p", {50, -6, M_PI / 2}, 5, 2.5);
  builder.data().parking_spaces[0].polygon.resize(2);
  const auto map = builder.build();
  EXPECT_NE(map->whyUnusable("p").find("2 distinct vertices"), std::string::npos) << map->whyUnusable("p");
  EXPECT_EQ(map->whyUnusable("q"), "");
}

TEST_F(LaneAlongX, DerivesAHeadingWithoutAnyDrivableLane) {
  for (LaneData& lane : builder.data().lanes) lane.type = LaneType::kSidewalk;
  const double heading = headingOf({50, -6, M_PI / 2}, 5, 2.5, std::nullopt);
  EXPECT_NEAR(std::abs(heading), M_PI / 2, 1e-9);
}

}  // namespace
}  // namespace external_command
