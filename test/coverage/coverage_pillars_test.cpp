// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "external_command/core/error.h"
#include "sweeper.h"

namespace external_command {
namespace {

/// Two rows of posts:
///   +--------------------+
///   |   .    .    .    . |
///   |   .    .    .    . |
///   +--------------------+
CoverageArea hall() {
  CoverageArea area{box(0, 0, 60, 40), {}};
  for (const double y : {14.0, 27.0}) {
    for (const double x : {10.0, 23.0, 36.0, 49.0}) area.holes.push_back(post(x, y));
  }
  return area;
}

const CoverageArea kEmptyHall{box(0, 0, 60, 40), {}};

bool isBent(const SwathLine& line) { return !line.isLap() && line.arcs.size() > 1; }

std::size_t countBent(const CoverageResult& result) {
  return static_cast<std::size_t>(std::count_if(result.lines.begin(), result.lines.end(), isBent));
}

TEST(CoveragePillars, AreSweptPastOnSwathsThatBendRoundThem) {
  const CoverageResult result = planned(hall());
  EXPECT_GT(countBent(result), 0u);
  EXPECT_GT(result.coverage_ratio, 0.98);
  EXPECT_TRUE(isDrivable(result.path, hall()));
}

TEST(CoveragePillars, TakeHardlyMoreTurnsAndLengthThanNone) {
  const CoverageResult posts = planned(hall()), none = planned(kEmptyHall);
  EXPECT_LE(posts.turns, none.turns + 6);
  EXPECT_LE(posts.gear_changes, none.gear_changes + 12);
  EXPECT_LT(posts.length, 1.05 * none.length);
}

TEST(CoveragePillars, AreAllThatSwathsBendRound) {
  EXPECT_EQ(countBent(planned(kEmptyHall)), 0u);
  const CoverageArea block{box(0, 0, 60, 40), {box(24, 16, 34, 24)}};
  EXPECT_EQ(countBent(planned(block)), 0u) << "a lap leads round this hole";
}

/// Posts across the whole hall, too near to each other for the vehicle.
TEST(CoveragePillars, EndSwathsWhereTheyStandTooClose) {
  CoverageArea fenced{box(0, 0, 40, 20), {}};
  for (double y = 0.5; y < 20.0; y += 1.5) fenced.holes.push_back(post(20.0, y));
  const CoverageResult result = planned(fenced);
  EXPECT_TRUE(isDrivable(result.path, fenced));
  for (const ReferencePoint& point : result.path) EXPECT_LT(point.x, 20.0);
}

TEST(CoveragePillars, ArePassedForwardByAVehicleThatIsNotToReverse) {
  CoverageParams forward = params();
  forward.reverse_to_turn = false;
  const CoverageArea empty{box(0, 0, 44, 28), {}};
  const CoverageArea hall{empty.outer, {post(15, 14), post(29, 14)}};
  const CoverageResult result = CoveragePlanner(sweeper(), forward).plan(hall, kStart, {}, {});
  const CoverageResult none = CoveragePlanner(sweeper(), forward).plan(empty, kStart, {}, {});
  EXPECT_LE(result.gear_changes, none.gear_changes);
  EXPECT_GT(countBent(result), 0u);
  EXPECT_GT(result.coverage_ratio, 0.95);
  EXPECT_TRUE(isDrivable(result.path, hall));
}

TEST(CoveragePillars, DoNotTurnTheSwathsFromTheHeadingThatIsWished) {
  CoverageParams wished = params();
  wished.swath_heading = 0.3;
  wished.headland_laps = 1;
  const CoverageResult result = CoveragePlanner(sweeper(), wished).plan(hall(), kStart, {}, {});
  EXPECT_GT(countBent(result), 0u);
  for (const SwathLine& line : result.lines) {
    if (line.isLap()) continue;
    EXPECT_NEAR(std::remainder(line.start.heading - 0.3, M_PI), 0.0, 1e-6);
  }
}

TEST(CoveragePillars, LetABentSwathBeResumedBesideThem) {
  const CoverageResult whole = planned(hall());
  const auto bent = [&](const Swath& swath) { return isBent(whole.lines[swath.index]); };
  const Swath& swath = *std::find_if(whole.swaths.begin(), whole.swaths.end(), bent);
  const auto& arcs = whole.lines[swath.index].arcs;
  CoverageProgress progress;
  progress.lines = whole.lines;
  for (std::size_t i = 0; i < swath.index; ++i) progress.sweep(i, whole.lines[i].length());
  const double swept = arcs[0].length + arcs[1].length / 2.0;
  progress.sweep(swath.index, swept);
  const Pose2d there = endOf(whole.lines[swath.index].start, {arcs[0], {arcs[1].length / 2.0, arcs[1].kappa}});
  const CoverageResult rest = CoveragePlanner(sweeper(), params()).plan(hall(), there, progress, {});
  EXPECT_EQ(rest.swaths.front().index, swath.index);
  EXPECT_NEAR(rest.swaths.front().from, swept, 1e-6);
  EXPECT_NEAR(rest.coverage_ratio, whole.coverage_ratio, 0.01);
  EXPECT_TRUE(isDrivable(rest.path, hall()));
}

Polygon disc(const Point2d& centre, double radius) {
  std::vector<Point2d> points;
  for (int i = 0; i < 64; ++i) points.push_back(centre + radius * unitVector(i * M_PI / 32.0));
  return Polygon(points, "disc");
}

TEST(CoveragePillars, LeaveRoomForALapOfARoundField) {
  const CoverageArea lawn{disc({0, 0}, 25.0), {disc({0.0, -23.5}, 0.3)}};
  const CoverageResult result = CoveragePlanner(sweeper(), params()).plan(lawn, Pose2d{0.0, 0.0, 0.0}, {}, {});
  const auto isLong = [](const SwathLine& line) { return line.isLap() && line.length() > 120.0; };
  EXPECT_TRUE(std::any_of(result.lines.begin(), result.lines.end(), isLong));
  EXPECT_LE(result.turns, 25u);
  EXPECT_GT(result.coverage_ratio, 0.98);
  EXPECT_TRUE(isDrivable(result.path, lawn));
}

}  // namespace
}  // namespace external_command
