// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "external_command/core/driving_time.h"
#include "sweeper.h"

namespace external_command {
namespace {

TEST(CoveragePlanner, TurnsForwardWhereTheHeadlandHasRoom) {
  const CoverageArea area{box(0, 0, 60, 40), {}};
  const CoverageResult result = planned(area);
  EXPECT_LE(result.gear_changes, result.turns);
  EXPECT_GT(result.coverage_ratio, 0.98);
  EXPECT_TRUE(isDrivable(result.path, area));
}

CoverageResult plannedAt(double turn_speed, const CoverageArea& area) {
  CoverageParams wished = params();
  wished.turn_speed = turn_speed;
  return CoveragePlanner(sweeper(), wished).plan(area, kStart, {}, {});
}

/// In turns, of half of full lock at least, without a change of gear.
std::size_t jumpsOfSteering(const Path& path) {
  std::size_t jumps = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool stands = path[i].direction != path[i - 1].direction;
    jumps += !stands && !path[i].tool_on && std::abs(path[i].kappa - path[i - 1].kappa) > 0.5 * sweeper().maxKappa();
  }
  return jumps;
}

double drivingTimeOf(const CoverageResult& result) {
  Path path = result.path;
  limitSpeeds(sweeper(), &path);
  return DrivingTime(sweeper(), std::make_shared<Path>(std::move(path))).left(0.0, 0.0);
}

TEST(CoveragePlanner, SteersGraduallyIntoTurnsAndOutOfThem) {
  const CoverageArea area{box(0, 0, 60, 40), {}};
  const CoverageResult sudden = plannedAt(0.0, area), gradual = plannedAt(2.0, area);
  ASSERT_GT(jumpsOfSteering(sudden.path), sudden.turns);
  EXPECT_LT(jumpsOfSteering(gradual.path), jumpsOfSteering(sudden.path) / 3);
  EXPECT_LT(drivingTimeOf(gradual), 0.97 * drivingTimeOf(sudden));
  EXPECT_TRUE(isDrivable(sudden.path, area));
  EXPECT_TRUE(isDrivable(gradual.path, area));
}

TEST(CoveragePlanner, SweepsTheSameLinesHoweverItSteersBetweenThem) {
  const CoverageArea area{box(0, 0, 60, 40), {box(28, 18, 32, 22)}};
  const CoverageResult sudden = plannedAt(0.0, area), gradual = plannedAt(2.0, area);
  ASSERT_EQ(gradual.swaths.size(), sudden.swaths.size());
  for (std::size_t i = 0; i < gradual.swaths.size(); ++i) {
    const Swath &swath = gradual.swaths[i], &other = sudden.swaths[i];
    EXPECT_EQ(swath.index, other.index);
    EXPECT_EQ(swath.length, other.length);
    EXPECT_NEAR(gradual.path[swath.last].s - gradual.path[swath.first].s, swath.length, 0.05);
    EXPECT_EQ(swath.covered.size(), swath.last - swath.first + 1);
  }
  EXPECT_NEAR(gradual.coverage_ratio, sudden.coverage_ratio, 0.003);
  EXPECT_NEAR(gradual.length, sudden.length, 0.01 * sudden.length);
}

CoverageResult plannedForward(const CoverageArea& area, const Pose2d& start = kStart) {
  CoverageParams wished = params();
  wished.reverse_to_turn = false;
  return CoveragePlanner(sweeper(), wished).plan(area, start, {}, {});
}

TEST(CoveragePlanner, DoesNotReverseToTurnWhereThatIsNotWished) {
  const CoverageArea area{box(0, 0, 40, 30), {}};
  const CoverageResult result = plannedForward(area);
  EXPECT_EQ(result.gear_changes, 0u);
  EXPECT_GT(result.coverage_ratio, 0.95);
  EXPECT_TRUE(isDrivable(result.path, area));
}

TEST(CoveragePlanner, ComesNearTheBorderBetweenCornersThatTheNoseSwingsOutIn) {
  const CoverageResult result = plannedForward({box(0, 0, 60, 40), {}});
  std::size_t near = 0;
  for (const ReferencePoint& point : result.path) {
    near += point.tool_on && box(0, 0, 60, 40).distanceToBorder(point.pose().position()) < 0.51 * params().swath_width;
  }
  EXPECT_GT(near * params().spacing, 80.0) << "of a border of 200 m";
}

TEST(CoveragePlanner, LeavesSharpCornersForwardWhereThatIsWished) {
  const CoverageArea area{Polygon({{0, 0}, {70, 7}, {25, 56}}, "triangle"), {}};
  const CoverageResult result = plannedForward(area, {25, 20, 0.0});
  EXPECT_LE(result.gear_changes, 2u);
  EXPECT_GT(result.coverage_ratio, 0.8);
  EXPECT_TRUE(isDrivable(result.path, area));
}

TEST(CoveragePlanner, SweepsWhatItCanWhereThereIsNoRoomToTurnForward) {
  const CoverageArea area{box(0, 0, 60, 8), {}};
  const CoverageResult result = plannedForward(area, {5, 4, 0.0});
  EXPECT_FALSE(result.swaths.empty());
  EXPECT_TRUE(isDrivable(result.path, area));
}

Polygon circle(double radius) {
  std::vector<Point2d> points;
  for (int i = 0; i < 64; ++i) points.push_back(radius * unitVector(i * M_PI / 32.0));
  return Polygon(points, "circle");
}

TEST(CoveragePlanner, SweepsAThinRingInLaps) {
  const CoverageArea area{circle(40.0), {circle(33.0)}};
  const CoverageResult result = CoveragePlanner(sweeper(), params()).plan(area, Pose2d{36.5, 0.0, 1.5708}, {}, {});
  EXPECT_GT(result.coverage_ratio, 0.97);
  EXPECT_LT(result.length, 1.3 * result.reachable_area / params().swath_width);
  EXPECT_LE(result.gear_changes, 10u);
  EXPECT_TRUE(isDrivable(result.path, area));
}

/// Its width is no multiple of a swath's: strips are left that are narrower.
TEST(CoveragePlanner, SweepsStripsThatAreLeftAlongNotAcross) {
  const CoverageArea area{Polygon({{0, 0}, {120, 0}, {120, 48}, {54, 48}, {54, 120}, {0, 120}}, "angle"), {}};
  const CoverageResult result = planned(area);
  std::size_t stubs = 0;
  for (const SwathLine& line : result.lines) stubs += !line.isLap() && line.length() < 2.0 * params().swath_width;
  EXPECT_LE(stubs, 4u);
  EXPECT_GT(result.coverage_ratio, 0.99);
}

TEST(CoveragePlanner, SweepsLargerGapsForAFewMetresMore) {
  const CoverageArea area{box(0, 0, 40, 30), {box(18, 12, 22, 16), box(30, 20, 31, 21)}};
  CoverageParams lavish = params(), careful = params();
  lavish.target_coverage = careful.target_coverage = 0.9;
  lavish.max_gap = 0.0;
  careful.max_gap = 0.5;
  const CoverageResult gaps = CoveragePlanner(sweeper(), lavish).plan(area, kStart, {}, {});
  const CoverageResult none = CoveragePlanner(sweeper(), careful).plan(area, kStart, {}, {});
  EXPECT_GE(none.coverage_ratio, gaps.coverage_ratio);
  EXPECT_LT(none.length, 1.03 * gaps.length);
  EXPECT_TRUE(isDrivable(none.path, area));
}

/// What sweeps a gap does not pay, and stays in the plan all the same when that is improved once more.
TEST(CoveragePlanner, KeepsGapsSweptThatDoNotPay) {
  const CoverageArea yard{box(0, 0, 50, 50), {box(20, 20, 30, 30), box(35, 10, 41, 17)}};
  const CoverageArea lawn{circle(25.0), {box(-6, -4, 5, 8)}};
  for (const auto& [area, start] : {std::pair(yard, Pose2d{4.0, 4.0, 0.0}), std::pair(lawn, Pose2d{4.0, -20.0, 0.0})}) {
    CoverageParams lavish = params(), careful = params();
    lavish.target_coverage = careful.target_coverage = 0.9;
    lavish.max_gap = 0.0;
    careful.max_gap = 0.5;
    const CoverageResult gaps = CoveragePlanner(sweeper(), lavish).plan(area, start, {}, {});
    const CoverageResult none = CoveragePlanner(sweeper(), careful).plan(area, start, {}, {});
    EXPECT_GT(none.coverage_ratio, gaps.coverage_ratio + 0.002);
    EXPECT_LT(none.length, 1.03 * gaps.length);
    EXPECT_TRUE(isDrivable(none.path, area));
  }
}

}  // namespace
}  // namespace external_command
