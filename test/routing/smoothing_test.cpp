// SPDX-License-Identifier: Apache-2.0
#include "../../src/routing/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace external_command {
namespace {

std::vector<Point2d> circle(std::size_t count) {
  std::vector<Point2d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(10.0 * unitVector(0.05 * static_cast<double>(i)));
  return points;
}

/// What smooth() minimizes.
double cost(const std::vector<Point2d>& smoothed, const std::vector<Point2d>& given, double scale) {
  double sum = 0.0;
  for (std::size_t i = 0; i < given.size(); ++i) sum += (smoothed[i] - given[i]).squaredNorm();
  for (std::size_t i = 0; i + 3 < given.size(); ++i) {
    const Point2d third = smoothed[i + 3] - 3.0 * smoothed[i + 2] + 3.0 * smoothed[i + 1] - smoothed[i];
    sum += std::pow(scale, 6.0) * third.squaredNorm();
  }
  return sum;
}

TEST(Smoothing, LeavesLinesAndCirclesAsTheyAre) {
  std::vector<Point2d> points = circle(300);
  smooth(3.0, 0, 299, &points);
  for (const Point2d& point : points) EXPECT_NEAR(point.norm(), 10.0, 0.01);
}

TEST(Smoothing, FindsTheMinimum) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.1);
  for (const std::size_t count : {4u, 5u, 8u, 50u, 400u}) {
    std::vector<Point2d> given = circle(count);
    for (Point2d& point : given) point += Point2d(noise(random), noise(random));
    std::vector<Point2d> smoothed = given;
    smooth(2.5, 0, count - 1, &smoothed);
    const double least = cost(smoothed, given, 2.5);
    for (std::size_t i = 1; i + 1 < count; ++i) {
      for (const double step : {-1e-3, 1e-3}) {
        std::vector<Point2d> other = smoothed;
        other[i].x() += step;
        EXPECT_GT(cost(other, given, 2.5), least) << count << " points, point " << i;
      }
    }
  }
}

TEST(Smoothing, HoldsTheEnds) {
  std::vector<Point2d> points = circle(60);
  points[10] += Point2d(0.2, 0.0);
  points[50] += Point2d(0.0, 0.2);
  const Point2d first = points[10], last = points[50];
  smooth(3.0, 10, 50, &points);
  EXPECT_EQ(points[10], first);
  EXPECT_EQ(points[50], last);
  EXPECT_LT((points[11] - 2.0 * points[10] + points[9]).norm(), 0.05) << "its neighbours follow";
}

TEST(Smoothing, LeavesAFewPointsAlone) {
  std::vector<Point2d> points = {{0, 0}, {1, 1}, {2, 0}};
  smooth(3.0, 0, 2, &points);
  EXPECT_EQ(points[1], Point2d(1, 1));
}

}  // namespace
}  // namespace external_command
