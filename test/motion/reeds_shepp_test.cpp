// SPDX-License-Identifier: Apache-2.0
#include "external_command/motion/reeds_shepp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/path_matchers.h"

namespace external_command {
namespace {

constexpr double kRadius = 3.0;

double lengthOf(const std::vector<ArcSegment>& arcs) {
  double length = 0.0;
  for (const ArcSegment& arc : arcs) length += std::abs(arc.length);
  return length;
}

/// Pairs of poses from 1 cm to 100 m apart, some of them aligned.
std::vector<std::pair<Pose2d, Pose2d>> posePairs(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<std::pair<Pose2d, Pose2d>> pairs;
  for (int i = 0; i < count; ++i) {
    const double size = std::pow(10.0, 2.0 * unit(random));
    Pose2d from{size * unit(random), size * unit(random), M_PI * unit(random)};
    Pose2d to{size * unit(random), size * unit(random), M_PI * unit(random)};
    if (i % 5 == 0) to.heading = from.heading;
    if (i % 7 == 0) from.heading = 0.0, to.y = from.y;
    pairs.emplace_back(from, to);
  }
  return pairs;
}

testing::AssertionResult endsAt(const Pose2d& from, const std::vector<ArcSegment>& arcs, const Pose2d& to) {
  const Pose2d end = endOf(from, arcs);
  if ((end.position() - to.position()).norm() < 1e-6 && std::abs(angleBetween(end.heading, to.heading)) < 1e-6) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "ends at " << end.x << " " << end.y << " " << end.heading;
}

TEST(ReedsShepp, EndsEveryCurveExactlyAtTheGoal) {
  for (const auto& [from, to] : posePairs(1, 3000)) {
    for (const SteeringCurve& curve : reedsSheppCurves(from, to, kRadius, 3.0)) {
      ASSERT_TRUE(endsAt(from, curve.arcs, to));
      ASSERT_NEAR(curve.length, lengthOf(curve.arcs), 1e-9);
      for (const ArcSegment& arc : curve.arcs) ASSERT_LE(std::abs(arc.kappa), 1.0 / kRadius + 1e-12);
    }
  }
}

TEST(ReedsShepp, SortsCurvesByLengthAndGearChanges) {
  for (const auto& [from, to] : posePairs(2, 300)) {
    const auto curves = reedsSheppCurves(from, to, kRadius, 3.0);
    ASSERT_FALSE(curves.empty());
    for (std::size_t i = 0; i < curves.size(); ++i) {
      ASSERT_NEAR(curves[i].cost, curves[i].length + 3.0 * curves[i].gear_changes, 1e-9);
      if (i > 0) {
        ASSERT_GE(curves[i].cost, curves[i - 1].cost);
      }
    }
  }
}

TEST(ReedsShepp, IsAsLongBackAsThere) {
  for (const auto& [from, to] : posePairs(3, 1000)) {
    EXPECT_NEAR(reedsSheppLength(from, to, kRadius), reedsSheppLength(to, from, kRadius), 1e-6);
  }
}

TEST(ReedsShepp, IsNoLongerThanTheWayOverAThirdPose) {
  const auto pairs = posePairs(4, 1000);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const auto& [from, to] = pairs[i];
    const Pose2d via = pairs[i - 1].first;
    EXPECT_LE(reedsSheppLength(from, to, kRadius),
              reedsSheppLength(from, via, kRadius) + reedsSheppLength(via, to, kRadius) + 1e-6);
  }
}

TEST(ReedsShepp, IsNeitherShorterThanTheStraightLineNorLongerThanDubins) {
  for (const auto& [from, to] : posePairs(5, 1000)) {
    const double length = reedsSheppLength(from, to, kRadius);
    EXPECT_GE(length, (to.position() - from.position()).norm() - 1e-9);
    EXPECT_LE(length, lengthOf(shortestDubins(from, to, kRadius)) + 1e-6);
  }
}

TEST(ReedsShepp, GivesASingleArcBack) {
  for (const double turn : {0.01, 0.3, 1.0, 1.5}) {
    for (const double sign : {1.0, -1.0}) {
      for (const double steer : {1.0, -1.0}) {
        const ArcSegment arc{sign * turn * kRadius, steer / kRadius};
        const Pose2d from{12.3, -4.5, 0.7};
        const auto found = shortestReedsShepp(from, advance(from, arc), kRadius);
        ASSERT_EQ(found.size(), 1U) << turn;
        EXPECT_NEAR(found[0].length, arc.length, 1e-6);
        EXPECT_EQ(found[0].kappa, arc.kappa);
      }
    }
  }
}

TEST(ReedsShepp, KnowsAFewCurvesByHeart) {
  EXPECT_NEAR(reedsSheppLength({0, 0, 0}, {5, 0, 0}, kRadius), 5.0, 1e-9);
  EXPECT_NEAR(reedsSheppLength({0, 0, 0}, {-5, 0, 0}, kRadius), 5.0, 1e-9);
  EXPECT_NEAR(reedsSheppLength({0, 0, 0}, {kRadius, kRadius, M_PI / 2}, kRadius), kRadius * M_PI / 2, 1e-9);
  // turning around on the spot: three arcs of 60 degrees
  EXPECT_NEAR(reedsSheppLength({0, 0, 0}, {0, 0, M_PI}, kRadius), kRadius * M_PI, 1e-9);
}

TEST(ReedsShepp, IsEmptyFromAPoseToItself) {
  EXPECT_TRUE(shortestReedsShepp({1, 2, 3}, {1, 2, 3}, kRadius).empty());
  EXPECT_TRUE(shortestDubins({1, 2, 3}, {1, 2, 3}, kRadius).empty());
}

TEST(Dubins, DrivesForwardOnlyAndEndsAtTheGoal) {
  for (const auto& [from, to] : posePairs(6, 3000)) {
    const auto curves = dubinsCurves(from, to, kRadius);
    ASSERT_FALSE(curves.empty());
    EXPECT_NEAR(curves.front().length, lengthOf(shortestDubins(from, to, kRadius)), 1e-9);
    for (const SteeringCurve& curve : curves) {
      ASSERT_TRUE(endsAt(from, curve.arcs, to));
      EXPECT_EQ(curve.gear_changes, 0U);
      for (const ArcSegment& arc : curve.arcs) ASSERT_GT(arc.length, 0.0);
    }
  }
}

TEST(Dubins, TakesAFullCircleToGetAStepBack) {
  const double length = lengthOf(shortestDubins({0, 0, 0}, {-1e-3, 0, 0}, kRadius));
  EXPECT_NEAR(length, 2.0 * M_PI * kRadius, 0.05);
}

TEST(SampleArcs, GivesADrivablePathWithTheExactEnd) {
  VehicleParams vehicle;
  vehicle.min_turning_radius = kRadius;
  for (const auto& [from, to] : posePairs(7, 200)) {
    const auto arcs = shortestReedsShepp(from, to, kRadius);
    const Path path = sampleArcs(from, arcs, 0.05);
    EXPECT_TRUE(isDrivable(path, vehicle));
    EXPECT_TRUE(joins(path, from, to));
    EXPECT_NEAR(path.back().s, lengthOf(arcs), 1e-9);
  }
}

TEST(SampleArcs, PutsAPointAtEveryGearChange) {
  const Path path = sampleArcs({0, 0, 0}, {{1.02, 0.0}, {-0.51, 0.3}}, 0.25);
  const auto cusp = std::find_if(path.begin(), path.end(), [](const auto& p) { return std::abs(p.x - 1.02) < 1e-9; });
  ASSERT_NE(cusp, path.end());
  EXPECT_EQ(cusp->direction, Direction::kForward);
  EXPECT_EQ(std::next(cusp)->direction, Direction::kReverse);
  EXPECT_EQ(gearChanges(path), 1U);
  EXPECT_NEAR(reverseLength(path), 0.51, 1e-9);
}

TEST(SampleArcs, IsOnePointWithoutArcs) { EXPECT_EQ(sampleArcs({1, 2, 3}, {}, 0.1).size(), 1U); }

}  // namespace
}  // namespace external_command
