// SPDX-License-Identifier: Apache-2.0
// HdMap::nearestLane and HdMap::lanesWithin, against looking at every lane.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "external_command/map/map_reader.h"
#include "map/map_files.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

/// The nearest place of each stretch whose segments all satisfy `query`.
std::vector<LaneMatch> passesOf(const Lane& lane, LaneIndex index, const Point2d& point, const LaneQuery& query) {
  std::vector<LaneMatch> passes;
  const std::vector<Point2d>& line = lane.center.points();
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double heading = query.heading ? headingOf(line[i + 1] - line[i]) : 0.0;
    const double distance = (nearestOnSegment(point, line[i], line[i + 1]) - point).norm();
    const bool turns = query.heading && std::abs(angleBetween(*query.heading, heading)) > query.max_heading_difference;
    if (turns || distance > query.max_distance) {
      goes_on = false;
      continue;
    }
    if (!goes_on) passes.push_back({index, {0.0, 0.0, distance}, heading});
    if (distance < passes.back().frenet.distance) passes.back() = {index, {0.0, 0.0, distance}, heading};
    goes_on = true;
  }
  return passes;
}

std::vector<LaneMatch> byBruteForce(const HdMap& map, const Point2d& point, const LaneQuery& query) {
  std::vector<LaneMatch> matches;
  for (LaneIndex i = 0; i < map.lanes().size(); ++i) {
    if (query.drivable_only && !map.lane(i).isDrivable()) continue;
    const auto passes = passesOf(map.lane(i), i, point, query);
    matches.insert(matches.end(), passes.begin(), passes.end());
  }
  std::stable_sort(matches.begin(), matches.end(),
                   [](const auto& a, const auto& b) { return a.frenet.distance < b.frenet.distance; });
  return matches;
}

/// Points in and around the map; queries of every kind.
::testing::AssertionResult agreesWithBruteForce(const HdMap& map, unsigned seed, int rounds) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-0.1, 1.1), angle(-M_PI, M_PI), radius(0.0, 40.0);
  const Point2d size = map.box().max - map.box().min;
  for (int i = 0; i < rounds; ++i) {
    const Point2d point = map.box().min + Point2d(share(random) * size.x(), share(random) * size.y());
    LaneQuery query;
    query.drivable_only = i % 2 == 0;
    if (i % 3 != 0) query.heading = angle(random);
    if (i % 3 != 0) query.max_heading_difference = std::abs(angle(random));
    if (i % 5 != 0) query.max_distance = radius(random);
    const auto expected = byBruteForce(map, point, query);
    const auto nearest = map.nearestLane(point, query);
    const auto where = [&] { return ::testing::AssertionFailure() << "seed " << seed << " round " << i << ": "; };
    if (nearest.has_value() != !expected.empty()) return where() << "one finds a lane, the other does not";
    if (nearest && std::abs(nearest->frenet.distance - expected[0].frenet.distance) > 1e-9) {
      return where() << "nearest at " << nearest->frenet.distance << " m, not " << expected[0].frenet.distance;
    }
    const auto all = map.lanesWithin(point, query);
    if (all.size() != expected.size()) return where() << all.size() << " lanes, not " << expected.size();
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].lane != expected[k].lane) return where() << "lane " << k << " is another";
    }
  }
  return ::testing::AssertionSuccess();
}

TEST(LaneSearch, AgreesWithBruteForceOnRandomLanes) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-200.0, 200.0), turn(-0.5, 0.5);
    MapBuilder builder;
    for (unsigned i = 0; i < 3 * seed; ++i) {
      Pose2d pose{place(random), place(random), place(random)};
      std::vector<Point2d> points;
      for (unsigned k = 0; k < 2 + i * 3; ++k) {
        points.push_back(pose.position());
        pose = compose(pose, {3.0, 0.0, turn(random)});
      }
      builder.lane("lane_" + std::to_string(i), points);
      if (i % 3 == 1) builder.data().lanes.back().type = LaneType::kSidewalk;
    }
    EXPECT_TRUE(agreesWithBruteForce(*builder.build(), seed, 300));
  }
}

/// So many that several processors share the making of the tree.
TEST(LaneSearch, AgreesWithBruteForceOnManyLanes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0.0, 2000.0), offset(-20.0, 20.0);
  MapBuilder builder;
  for (int lane = 0; lane < 40000; ++lane) {
    const Point2d begin(place(random), place(random));
    builder.lane("lane_" + std::to_string(lane), begin, begin + Point2d(offset(random), offset(random)));
  }
  EXPECT_TRUE(agreesWithBruteForce(*builder.build(), 1, 30));
}

TEST(LaneSearch, AgreesWithBruteForceOnRealMaps) {
  const auto files = sharedMaps();
  if (files.empty()) GTEST_SKIP() << "no maps in " << EC_SHARED_DIR << "/data/maps";
  for (const std::string& file : files) {
    EXPECT_TRUE(agreesWithBruteForce(*readMap(file, {}), 1, 2000)) << file;
  }
}

/// out and back on one lane, 6 m apart
TEST(LaneSearch, TakesTheStretchOfALaneThatHasTheHeading) {
  MapBuilder builder;
  builder.lane("hairpin", {{0, 0}, {100, 0}, {100, 6}, {0, 6}});
  const auto map = builder.build();
  LaneQuery east;
  east.heading = 0.0;
  east.max_heading_difference = 0.5;
  east.max_distance = 10.0;
  EXPECT_NEAR(map->nearestLane({50, 4}, east)->frenet.s, 50.0, 1e-9) << "the other leg is nearer";
  ASSERT_EQ(map->lanesWithin({50, 4}, east).size(), 1u);
  east.heading = M_PI;
  EXPECT_NEAR(map->nearestLane({50, 2}, east)->frenet.s, 156.0, 1e-9);
  EXPECT_FALSE(map->nearestLane({50, -5}, east));
}

TEST(LaneSearch, FindsALaneOnceForEachTimeItPasses) {
  MapBuilder builder;
  builder.lane("hairpin", {{0, 0}, {100, 0}, {100, 6}, {0, 6}});
  const auto map = builder.build();
  LaneQuery query;
  query.max_distance = 10.0;
  const auto passes = map->lanesWithin({50, 2}, query);
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_NEAR(passes[0].frenet.s, 50.0, 1e-9);
  EXPECT_NEAR(passes[0].frenet.l, 2.0, 1e-9);
  EXPECT_NEAR(passes[1].frenet.s, 156.0, 1e-9);
  EXPECT_NEAR(passes[1].frenet.l, 4.0, 1e-9);
}

TEST(LaneSearch, TakesLimitsInclusively) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {100, 0});
  const auto map = builder.build();
  LaneQuery query;
  query.max_distance = 3.0;
  EXPECT_TRUE(map->nearestLane({50, 3.0}, query));
  EXPECT_FALSE(map->nearestLane({50, 3.001}, query));
  query.heading = 1.0;
  query.max_heading_difference = 1.0;
  EXPECT_TRUE(map->nearestLane({50, 3.0}, query));
  query.max_heading_difference = 0.999;
  EXPECT_FALSE(map->nearestLane({50, 3.0}, query));
}

TEST(LaneSearch, TakesTheFirstOfTwoLanesAtTheSamePlace) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {100, 0}).lane("b", {0, 0}, {100, 0});
  const auto map = builder.build();
  EXPECT_EQ(map->nearestLane({50, 3}, {})->lane, laneIndex(*map, "a"));
  EXPECT_EQ(map->lanesWithin({50, 3}, {}).size(), 2u);
}

TEST(LaneSearch, FindsNothingForNonsense) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {100, 0});
  const auto map = builder.build();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  LaneQuery query;
  EXPECT_FALSE(map->nearestLane({nan, 0}, query));
  EXPECT_TRUE(map->lanesWithin({0, nan}, query).empty());
  query.heading = nan;
  EXPECT_FALSE(map->nearestLane({50, 0}, query));
  query.heading.reset();
  for (const double radius : {-1.0, nan}) {
    query.max_distance = radius;
    EXPECT_FALSE(map->nearestLane({50, 0}, query));
  }
}

}  // namespace
}  // namespace external_command
