// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path_borders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace external_command {
namespace {

WaypointLine lineThrough(const std::vector<Point2d>& points, const std::vector<double>& headings = {}) {
  WaypointLine line;
  line.points = points;
  line.headings = headings;
  return line;
}

/// Every point of the line moved by these to the sides of the way there.
PathBorders bordersOf(const WaypointLine& line, double left, double right) {
  PathBorders borders;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const std::size_t from = i == 0 ? 0 : i - 1;
    const Point2d way = (line.points[from + 1] - line.points[from]).normalized();
    borders.left.push_back(line.points[i] + left * Point2d(-way.y(), way.x()));
    borders.right.push_back(line.points[i] - right * Point2d(-way.y(), way.x()));
  }
  return borders;
}

void swapFrom(std::size_t begin, std::size_t end, PathBorders* borders) {
  for (std::size_t i = begin; i < end; ++i) std::swap(borders->left[i], borders->right[i]);
}

WaypointLine bend(double radius) {
  std::vector<Point2d> points;
  for (int i = 0; i <= 20; ++i) points.emplace_back(radius * std::sin(0.1 * i), radius * (1.0 - std::cos(0.1 * i)));
  return lineThrough(points);
}

const std::vector<Point2d> kStraight = {{0.0, 0.0}, {10.0, 0.0}, {20.0, 0.0}};

TEST(PathBorders, TakesBordersOnTheirSides) {
  for (const double heading : {0.0, 1.0, 3.0, -2.0}) {
    const Point2d along = unitVector(heading);
    const WaypointLine line = lineThrough({833978.0 * along, 833988.0 * along, 833998.0 * along});
    EXPECT_FALSE(swappedBorders(line, bordersOf(line, 2.0, 1.5)));
    EXPECT_FALSE(crossedBorder(line, bordersOf(line, 2.0, 1.5)));
  }
  for (const double radius : {3.0, 30.0}) {
    // the border inside the tighter bend lies beyond its centre
    EXPECT_FALSE(swappedBorders(bend(radius), bordersOf(bend(radius), 5.0, 5.0))) << radius;
    EXPECT_FALSE(crossedBorder(bend(radius), bordersOf(bend(radius), 5.0, 5.0))) << radius;
  }
}

TEST(PathBorders, FindsBordersThatAreSwapped) {
  const WaypointLine line = lineThrough(kStraight);
  const auto swapped = swappedBorders(line, bordersOf(line, -2.0, -1.5));
  ASSERT_TRUE(swapped);
  EXPECT_EQ(swapped->waypoint, 0u);
  EXPECT_DOUBLE_EQ(swapped->left, -2.0);
  EXPECT_DOUBLE_EQ(swapped->right, -1.5);
  EXPECT_TRUE(swappedBorders(bend(3.0), bordersOf(bend(3.0), -1.0, -1.0)));
}

TEST(PathBorders, FindsAPartThatIsSwapped) {
  PathBorders borders = bordersOf(bend(30.0), 2.0, 2.0);
  swapFrom(7, 9, &borders);
  const auto swapped = swappedBorders(bend(30.0), borders);
  ASSERT_TRUE(swapped);
  EXPECT_EQ(swapped->waypoint, 7u);
}

TEST(PathBorders, FindsALineThatLeavesItsBorders) {
  const WaypointLine line = lineThrough(kStraight);
  const PathBorders borders = bordersOf(line, -1.0, 4.0);
  EXPECT_FALSE(swappedBorders(line, borders));
  const auto crossed = crossedBorder(line, borders);
  ASSERT_TRUE(crossed);
  EXPECT_DOUBLE_EQ(crossed->left, -1.0);
  EXPECT_DOUBLE_EQ(crossed->right, 4.0);
}

TEST(PathBorders, TakesBordersThatTouchTheLine) {
  const WaypointLine line = lineThrough(kStraight);
  EXPECT_FALSE(swappedBorders(line, bordersOf(line, 0.0, 0.0)));
  EXPECT_FALSE(crossedBorder(line, bordersOf(line, 0.0, -0.005)));
}

TEST(PathBorders, DoesNotJudgeWhereTheVehicleReverses) {
  const std::vector<Point2d> there_and_back = {{0.0, 0.0}, {10.0, 0.0}, {0.0, 0.0}};
  const WaypointLine line = lineThrough(there_and_back, {0.0, 0.0, 0.0});
  const std::vector<Point2d> north = {{0.0, 2.0}, {10.0, 2.0}, {0.0, 2.0}};
  const std::vector<Point2d> south = {{0.0, -2.0}, {10.0, -2.0}, {0.0, -2.0}};
  EXPECT_FALSE(swappedBorders(line, {north, south}));
  EXPECT_TRUE(swappedBorders(line, {south, north}));
  const WaypointLine reverse = lineThrough(kStraight, {M_PI, M_PI, M_PI});
  EXPECT_FALSE(swappedBorders(reverse, {south, north}));
  EXPECT_FALSE(swappedBorders(reverse, {north, south}));
}

TEST(PathBorders, TakesCornersAndPointsOfAVehicleThatStands) {
  const WaypointLine corner = lineThrough({{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}});
  EXPECT_FALSE(
      swappedBorders(corner, {{{0.0, 2.0}, {8.0, 2.0}, {8.0, 10.0}}, {{0.0, -2.0}, {12.0, -2.0}, {12.0, 10.0}}}));
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.03);
  std::vector<Point2d> recorded;
  for (int i = 0; i < 100; ++i) recorded.emplace_back(noise(random), noise(random));
  for (int i = 1; i < 100; ++i) recorded.emplace_back(0.2 * i, noise(random));
  PathBorders borders;
  for (const Point2d& point : recorded) {
    borders.left.emplace_back(point.x(), 2.0);
    borders.right.emplace_back(point.x(), -2.0);
  }
  EXPECT_FALSE(swappedBorders(lineThrough(recorded), borders));
  EXPECT_FALSE(crossedBorder(lineThrough(recorded), borders));
}

}  // namespace
}  // namespace external_command
