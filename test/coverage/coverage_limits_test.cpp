// SPDX-License-Identifier: Apache-2.0
// Areas that are large, or have many corners or narrow parts.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "sweeper.h"

namespace external_command {
namespace {

/// A lane of 4.5 m, wound up forty times.
Polygon spiral() {
  constexpr int kSides = 8000;
  std::vector<Point2d> points, back;
  for (int i = 0; i <= kSides; ++i) {
    const double angle = 80.0 * M_PI * i / kSides, radius = 15.0 + 6.0 * angle / (2.0 * M_PI);
    points.push_back((radius + 4.5) * unitVector(angle));
    back.push_back(radius * unitVector(angle));
  }
  points.insert(points.end(), back.rbegin(), back.rend());
  return {points, "spiral"};
}

/// A star of so many rays of unequal length, thinner than the vehicle.
Polygon star() {
  constexpr int kRays = 10000;
  std::mt19937 random(5);  // NOLINT(cert-msc51-cpp): the same star each time
  std::vector<Point2d> points;
  for (int i = 0; i < kRays; ++i) {
    points.push_back((90.0 + static_cast<double>(random() % 110)) * unitVector(2.0 * M_PI * i / kRays));
  }
  return {points, "star"};
}

/// [s] from the moment that planning is cancelled, or its time is used up, until it ends.
double overrun(const Polygon& area, double time_budget, double cancel_after) {
  CoverageParams hurried = params();
  hurried.time_budget = time_budget;
  const CancelSource source;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::duration<double>(cancel_after));
    source.cancel();
  });
  const auto began = std::chrono::steady_clock::now();
  try {
    CoveragePlanner(sweeper(), hurried).plan({area, {}}, std::nullopt, {}, source.token());
  } catch (const Error&) {
    // Cancelled or out of time, as it was to be.
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  canceller.join();
  return took.count() - std::min(time_budget, cancel_after);
}

TEST(CoverageOfManyCorners, EndsSoonAfterItIsCancelled) {
  EXPECT_LT(overrun(spiral(), 3600.0, 1.5), 3.0);
  EXPECT_LT(overrun(star(), 3600.0, 0.5), 3.0);
}

TEST(CoverageOfManyCorners, EndsWhenItsTimeIsUsedUp) {
  EXPECT_LT(overrun(spiral(), 1.5, 1.6), 3.0);
  EXPECT_LT(overrun(star(), 0.5, 0.6), 3.0);
}

/// A strip of 12 m, and fingers of 9 m that reach 40 m up from it.
TEST(CoverageOfNarrowFingers, LeavesLittle) {
  constexpr int kFingers = 6;
  std::vector<Point2d> points{{0, 0}};
  for (int i = 0; i < kFingers; ++i) {
    const double x = 14.0 * i;
    for (const Point2d& point : std::vector<Point2d>{{x, 12}, {x, 52}, {x + 9, 52}, {x + 9, 12}}) {
      points.push_back(point);
    }
  }
  points.emplace_back(points.back().x(), 0.0);
  CoverageParams wide = params();
  wide.swath_width = 4.0;
  const CoverageResult result =
      CoveragePlanner(tractor(), wide).plan({Polygon(points, "comb"), {}}, Pose2d{20.0, 6.0, 0.0}, {}, {});
  EXPECT_GT(result.coverage_ratio, 0.965);
}

TEST(CoverageOfLargeAreas, SweepsAlongTheLongSideThoughTheToolIsNarrow) {
  CoverageParams narrow = params();
  narrow.swath_width = 0.8;
  const CoverageResult result = CoveragePlanner(sweeper(), narrow).plan({box(0, 0, 400, 60), {}}, kStart, {}, {});
  EXPECT_GT(result.coverage_ratio, 0.98);
  EXPECT_LT(result.turns, 110U);  // 75 swaths and some laps; across it would be 500
}

}  // namespace
}  // namespace external_command
