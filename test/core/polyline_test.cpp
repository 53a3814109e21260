// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/polyline.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace external_command {
namespace {

/// 10 m to the east, then 10 m to the north.
Polyline corner() { return Polyline({{0, 0}, {10, 0}, {10, 10}}); }

/// A wandering line of `size` points.
Polyline randomLine(std::mt19937* random, int size) {
  std::uniform_real_distribution<double> turn(-0.7, 0.7), step(0.1, 8.0);
  Pose2d pose;
  std::vector<Point2d> points = {pose.position()};
  for (int i = 1; i < size; ++i) {
    pose = compose(pose, {step(*random), 0.0, turn(*random)});
    points.push_back(pose.position());
  }
  return Polyline(points);
}

TEST(Polyline, MeasuresItsLength) {
  EXPECT_EQ(corner().length(), 20.0);
  EXPECT_EQ(corner().arcLengths(), (std::vector<double>{0, 10, 20}));
}

TEST(Polyline, DropsPointsThatRepeatTheOneBefore) {
  const Polyline line({{0, 0}, {0, 0}, {0.0005, 0}, {10, 0}, {10, 0}});
  EXPECT_EQ(line.points().size(), 2u);
  EXPECT_EQ(line.length(), 10.0);
}

TEST(Polyline, RefusesFewerThanTwoDistinctPoints) {
  EXPECT_THROW(Polyline({}), std::invalid_argument);
  EXPECT_THROW(Polyline({{1, 1}}), std::invalid_argument);
  EXPECT_THROW(Polyline({{1, 1}, {1, 1}, {1.0001, 1}}), std::invalid_argument);
}

TEST(Polyline, RefusesPointsThatAreNoPlace) {
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300}) {
    EXPECT_THROW(Polyline({{0, 0}, {1, bad}, {2, 0}}), std::invalid_argument);
  }
}

TEST(Polyline, FindsPointAndHeadingByArcLength) {
  EXPECT_EQ(corner().pointAt(4), Point2d(4, 0));
  EXPECT_EQ(corner().pointAt(16), Point2d(10, 6));
  EXPECT_EQ(corner().headingAt(4), 0.0);
  EXPECT_NEAR(corner().headingAt(10), M_PI / 2, 1e-12);
  EXPECT_NEAR(corner().poseAt(15).heading, M_PI / 2, 1e-12);
}

TEST(Polyline, ClampsTheArcLengthToItsEnds) {
  EXPECT_EQ(corner().pointAt(-5), Point2d(0, 0));
  EXPECT_EQ(corner().pointAt(500), Point2d(10, 10));
  EXPECT_EQ(corner().headingAt(-5), 0.0);
  EXPECT_NEAR(corner().headingAt(20), M_PI / 2, 1e-12);
}

TEST(Polyline, ProjectsPointsOntoItsNearestPlace) {
  const FrenetPoint left = corner().project({4, 3});
  EXPECT_NEAR(left.s, 4.0, 1e-12);
  EXPECT_NEAR(left.l, 3.0, 1e-12);
  EXPECT_NEAR(left.distance, 3.0, 1e-12);
  EXPECT_NEAR(corner().project({12, 6}).l, -2.0, 1e-12);
}

TEST(Polyline, ProjectsPointsBeyondItsEndsOntoThem) {
  const FrenetPoint before = corner().project({-3, 4});
  EXPECT_EQ(before.s, 0.0);
  EXPECT_NEAR(before.l, 4.0, 1e-12);
  EXPECT_NEAR(before.distance, 5.0, 1e-12);
  EXPECT_NEAR(corner().project({10, 15}).s, 20.0, 1e-12);
}

TEST(Polyline, ProjectsItsOwnPointsOntoThemselves) {
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round) {
    const Polyline line = randomLine(&random, 2 + round);
    std::uniform_real_distribution<double> along(0.0, line.length());
    const double s = along(random);
    const FrenetPoint frenet = line.project(line.pointAt(s));
    EXPECT_NEAR(frenet.distance, 0.0, 1e-9);
    EXPECT_NEAR((line.pointAt(frenet.s) - line.pointAt(s)).norm(), 0.0, 1e-9);
  }
}

TEST(Polyline, IsNowhereNearerThanWhereItProjects) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-100.0, 100.0);
  for (int round = 0; round < 50; ++round) {
    const Polyline line = randomLine(&random, 30);
    const Point2d point(place(random), place(random));
    const FrenetPoint frenet = line.project(point);
    EXPECT_NEAR((line.pointAt(frenet.s) - point).norm(), frenet.distance, 1e-9);
    EXPECT_LE(std::abs(frenet.l), frenet.distance + 1e-9);
    for (double s = 0.0; s <= line.length(); s += 0.5) {
      EXPECT_GE((line.pointAt(s) - point).norm(), frenet.distance - 1e-9);
    }
  }
}

TEST(Polyline, IsCutIntoPartsThatMakeUpTheWhole) {
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    const Polyline line = randomLine(&random, 20);
    const double cut = std::uniform_real_distribution<double>(0.1, line.length() - 0.1)(random);
    const Polyline first = line.slice(0.0, cut), second = line.slice(cut, line.length());
    EXPECT_NEAR(first.length() + second.length(), line.length(), 1e-2);
    EXPECT_NEAR((first.points().back() - second.points().front()).norm(), 0.0, 1e-9);
    EXPECT_NEAR((first.points().back() - line.pointAt(cut)).norm(), 0.0, 1e-9);
  }
}

TEST(Polyline, RefusesToCutOutNothing) {
  EXPECT_THROW(corner().slice(5, 5), std::invalid_argument);
  EXPECT_THROW(corner().slice(8, 2), std::invalid_argument);
  EXPECT_THROW(corner().slice(30, 40), std::invalid_argument);
  EXPECT_EQ(corner().slice(-10, 40).length(), 20.0);
}

TEST(SampledCurve, HasTheHeadingsAndCurvatureOfItsCircle) {
  for (const double radius : {5.0, -8.0, 100.0}) {
    std::vector<Point2d> points;
    for (int i = 0; i <= 50; ++i) {
      const double angle = i * 0.5 / radius;
      points.push_back(radius * Point2d(std::sin(angle), 1.0 - std::cos(angle)));
    }
    const auto kappas = curvaturesOf(points), headings = headingsOf(points);
    ASSERT_EQ(kappas.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(kappas[i], 1.0 / radius, 1e-6);
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      EXPECT_NEAR(angleBetween(headings[i], 0.5 * i / radius), 0.0, 1e-6);
  }
}

TEST(SampledCurve, HasNoCurvatureWithFewerThanThreePoints) {
  EXPECT_TRUE(curvaturesOf({}).empty());
  EXPECT_EQ(curvaturesOf({{0, 0}, {1, 0}}), (std::vector<double>{0, 0}));
  EXPECT_EQ(headingsOf({{0, 0}}), std::vector<double>{0});
  EXPECT_TRUE(headingsOf({}).empty());
}

}  // namespace
}  // namespace external_command
