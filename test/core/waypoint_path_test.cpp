// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/waypoint_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "external_command/core/error.h"
#include "support/refusal.h"

namespace external_command {
namespace {

constexpr double kSpacing = 0.5;  // [m]

WaypointPath through(const WaypointLine& line, double target_speed = 0.0) {
  WaypointPath result = pathThrough(line, VehicleParams(), kSpacing, target_speed);
  limitSpeeds(VehicleParams(), &result.path);
  return result;
}

/// `count` points of a circle of `radius` [m] about the origin, `step` [m] apart, counter-clockwise from (radius, 0).
std::vector<Point2d> circle(double radius, double step, int count) {
  std::vector<Point2d> points;
  for (int i = 0; i < count; ++i) points.push_back(radius * unitVector(i * step / radius));
  return points;
}

testing::AssertionResult passesThrough(const Path& path, const std::vector<Point2d>& points) {
  std::size_t along = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    while (along < path.size() && (path[along].pose().position() - points[i]).norm() > 1e-9) ++along;
    if (along == path.size()) return testing::AssertionFailure() << "point " << i << " is not on the path, in order";
  }
  return testing::AssertionSuccess();
}

/// No gaps, and no motion across the heading, except at corners.
testing::AssertionResult isDriven(const Path& path, double max_slip = 0.05) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point2d step = path[i].pose().position() - path[i - 1].pose().position();
    if (step.norm() > 1.1 * kSpacing)
      return testing::AssertionFailure() << "a step of " << step.norm() << " m at " << i;
    if (path[i].s < path[i - 1].s) return testing::AssertionFailure() << "s decreases at " << i;
    const double mean = path[i - 1].heading + 0.5 * angleBetween(path[i - 1].heading, path[i].heading);
    const double motion = headingOf(step) + (path[i].direction == Direction::kForward ? 0.0 : M_PI);
    const double slip = std::abs(angleBetween(mean, motion));
    if (slip > max_slip) return testing::AssertionFailure() << "moves " << slip << " rad across its heading at " << i;
  }
  return testing::AssertionSuccess();
}

double distanceToLine(const Point2d& point, const Point2d& a, const Point2d& b) {
  return std::abs(cross((b - a).normalized(), point - a));
}

std::string lineRefusal(const WaypointLine& line) {
  return refusalOf([&] { through(line); });
}

TEST(WaypointPath, GoesStraightThroughTwoPoints) {
  const WaypointPath result = through({{{0.0, 0.0}, {10.0, 0.0}}, {}});
  EXPECT_EQ(result.path.size(), 21u);
  EXPECT_TRUE(isDriven(result.path));
  EXPECT_DOUBLE_EQ(result.path.back().s, 10.0);
  EXPECT_TRUE(result.tight_bends.empty());
  for (const ReferencePoint& point : result.path) EXPECT_DOUBLE_EQ(point.heading, 0.0);
}

TEST(WaypointPath, HasTheCurvatureOfTheCircleItsPointsLieOn) {
  for (const double radius : {5.0, 8.0, 30.0, 200.0}) {
    for (const double step : {0.3, 1.0, 2.0, 4.0}) {
      if (step > 0.45 * radius) continue;  // too few points to tell the circle
      const auto points = circle(radius, step, 12);
      const WaypointPath result = through({points, {}});
      EXPECT_TRUE(passesThrough(result.path, points));
      EXPECT_TRUE(isDriven(result.path));
      EXPECT_TRUE(result.tight_bends.empty()) << "radius " << radius << ", step " << step;
      for (const ReferencePoint& point : result.path) {
        EXPECT_NEAR(point.kappa * radius, 1.0, 0.02) << "radius " << radius << ", step " << step << ", s " << point.s;
        EXPECT_NEAR(point.pose().position().norm(), radius, 1e-3 * radius);
      }
      EXPECT_NEAR(result.path.back().s, 11 * step, 1e-3 * 11 * step);
    }
  }
}

TEST(WaypointPath, KeepsTheCurvatureOfACircleWithUnevenPoints) {
  std::vector<Point2d> points;
  for (const double angle : {0.0, 0.1, 0.15, 0.3, 0.36, 0.5, 0.6, 0.62}) points.push_back(10.0 * unitVector(angle));
  const WaypointPath result = through({points, {}});
  EXPECT_TRUE(result.tight_bends.empty());
  for (const ReferencePoint& point : result.path) EXPECT_NEAR(point.kappa, 0.1, 0.01);
}

TEST(WaypointPath, BendsToTheRightWithNegativeCurvature) {
  auto points = circle(10.0, 1.0, 10);
  std::reverse(points.begin(), points.end());
  for (const ReferencePoint& point : through({points, {}}).path) EXPECT_NEAR(point.kappa, -0.1, 0.002);
}

//              (50, 50)
//                 |      What lies beside a given path may not be free: a corner is neither cut nor rounded outwards.
//                 |
//  (0, 0) ---- (50, 0)
TEST(WaypointPath, KeepsToALineWithACornerAndTellsWhereItIs) {
  const std::vector<Point2d> points = {{0.0, 0.0}, {50.0, 0.0}, {50.0, 50.0}};
  const WaypointPath result = through({points, {}});
  EXPECT_TRUE(passesThrough(result.path, points));
  EXPECT_TRUE(isDriven(result.path, M_PI / 4));
  for (const ReferencePoint& point : result.path) {
    const Point2d position = point.pose().position();
    EXPECT_LT(std::min(distanceToLine(position, points[0], points[1]), distanceToLine(position, points[1], points[2])),
              1e-9);
  }
  ASSERT_EQ(result.tight_bends.size(), 1u);
  EXPECT_EQ(result.tight_bends[0].waypoint, 1u);
  EXPECT_NEAR((result.tight_bends[0].position - points[1]).norm(), 0.0, 1e-9);
  EXPECT_NEAR(result.tight_bends[0].corner, M_PI / 2, 1e-9);
}

TEST(WaypointPath, SmoothsTheTransitionFromAStraightIntoAnArc) {
  auto points = circle(20.0, 2.0, 10);
  points.insert(points.begin(), {20.0, -100.0});
  const WaypointPath result = through({points, {}});
  EXPECT_TRUE(passesThrough(result.path, points));
  EXPECT_TRUE(isDriven(result.path));
  EXPECT_TRUE(result.tight_bends.empty());
  for (const ReferencePoint& point : result.path) {
    EXPECT_NEAR(point.y < 0.0 ? point.x : point.pose().position().norm(), 20.0, 0.25) << "at y " << point.y;
  }
}

TEST(WaypointPath, TellsABendThatIsTooTightOnce) {
  auto points = circle(3.0, 0.5, 10);
  points.insert(points.begin(), {3.0, -10.0});
  const WaypointPath result = through({points, {}});
  ASSERT_EQ(result.tight_bends.size(), 1u);
  EXPECT_NEAR(result.tight_bends[0].radius, 3.0, 0.3);
  EXPECT_EQ(result.tight_bends[0].corner, 0.0);
  EXPECT_GE(result.tight_bends[0].waypoint, 1u);
}

TEST(WaypointPath, SlowsDownForBendsAndTheEnd) {
  const VehicleParams vehicle;
  const WaypointPath result = through({circle(10.0, 1.0, 40), {}});
  EXPECT_EQ(result.path.back().speed, 0.0);
  for (const ReferencePoint& point : result.path) {
    EXPECT_LE(point.speed, std::sqrt(vehicle.max_lateral_acceleration * 10.0) * 1.02);
  }
  EXPECT_DOUBLE_EQ(through({{{0.0, 0.0}, {100.0, 0.0}}, {}}, 3.0).path[5].speed, 3.0);
  EXPECT_DOUBLE_EQ(through({{{0.0, 0.0}, {100.0, 0.0}}, {}}).path[5].speed, vehicle.max_speed);
}

TEST(WaypointPath, ReversesWhereTheHeadingsPointAgainstTheMotion) {
  //  0 ----> 10   forward, heading 0; then back along the same line to 4
  const std::vector<Point2d> points = {{0.0, 0.0}, {5.0, 0.0}, {10.0, 0.0}, {4.0, 0.0}};
  const WaypointPath result = through({points, {0.0, 0.0, 0.0, 0.0}});
  EXPECT_TRUE(passesThrough(result.path, points));
  EXPECT_TRUE(isDriven(result.path));
  EXPECT_TRUE(result.tight_bends.empty());
  EXPECT_EQ(gearChanges(result.path), 1u);
  EXPECT_NEAR(reverseLength(result.path), 6.0, 1e-9);
  EXPECT_NEAR(result.path.back().s, 16.0, 1e-9);
  EXPECT_EQ(result.path.front().direction, Direction::kForward);
  EXPECT_EQ(result.path.back().direction, Direction::kReverse);
  EXPECT_EQ(result.path[20].speed, 0.0) << "it stops to change gear";
}

TEST(WaypointPath, ReversesAroundABendWithTheSignOfTheVehiclesTurn) {
  // Counter-clockwise on a circle, the rear first: the vehicle turns to the left, and steers to the right.
  const auto points = circle(10.0, 1.0, 12);
  std::vector<double> headings;
  for (int i = 0; i < 12; ++i) headings.push_back(i * 0.1 + M_PI / 2 + M_PI);
  const WaypointPath result = through({points, headings});
  EXPECT_TRUE(isDriven(result.path));
  for (const ReferencePoint& point : result.path) {
    EXPECT_EQ(point.direction, Direction::kReverse);
    EXPECT_NEAR(point.kappa, -0.1, 0.002);
  }
}

TEST(WaypointPath, TakesTheGivenHeadingsAtTheEnds) {
  const WaypointPath result = through({{{0.0, 0.0}, {4.0, 0.0}}, {0.1, -0.1}});
  EXPECT_NEAR(result.path.front().heading, 0.1, 1e-9);
  EXPECT_NEAR(result.path.back().heading, -0.1, 1e-9);
  EXPECT_TRUE(isDriven(result.path));
}

TEST(WaypointPath, WorksAtUtmCoordinates) {
  std::vector<Point2d> points = circle(10.0, 1.0, 12);
  for (Point2d& point : points) point += Point2d(586000.0, 4140000.0);
  const WaypointPath result = through({points, {}});
  EXPECT_TRUE(passesThrough(result.path, points));
  for (const ReferencePoint& point : result.path) EXPECT_NEAR(point.kappa, 0.1, 0.002);
}

TEST(WaypointPath, TakesRepeatedPointsForOne) {
  const WaypointLine repeated{{{0.0, 0.0}, {0.0, 0.0}, {5.0, 0.0}, {5.0, 1e-4}, {5.0, 0.0}, {9.0, 0.0}, {9.0, 0.0}}};
  EXPECT_EQ(through(repeated).path.size(), through({{{0.0, 0.0}, {5.0, 0.0}, {9.0, 0.0}}}).path.size());
  EXPECT_TRUE(isDriven(through(repeated).path));
}

TEST(WaypointPath, TakesTheLastHeadingOfARepeatedPoint) {
  const std::vector<Point2d> points = {{0.0, 0.0}, {0.0, 0.0}, {5.0, 0.0}, {5.0, 0.0}};
  EXPECT_EQ(lineRefusal({points, {1.5, 0.0, 1.5, 0.1}}), "");
  EXPECT_NE(lineRefusal({points, {0.0, 1.5, 0.0, 1.5}}).find("heading[0]"), std::string::npos);
}

TEST(WaypointPath, RefusesByTheNamesThatTheLineHas) {
  const double nan = std::nan("");
  const WaypointNames names{"poses", "the heading of poses"};
  EXPECT_EQ(lineRefusal({{{1.0, 2.0}, {nan, 0.0}}, {}, {}, names}), "poses[1] is not finite");
  EXPECT_NE(lineRefusal({{{1.0, 2.0}}, {}, {}, names}).find("poses has 1 points"), std::string::npos);
  const std::string across = lineRefusal({{{0.0, 0.0}, {5.0, 0.0}}, {1.5, 1.5}, {}, names});
  EXPECT_NE(across.find("the heading of poses[0] 1.50 rad"), std::string::npos) << across;
  EXPECT_NE(across.find("from poses[0] (0.00, 0.00) to poses[1]"), std::string::npos) << across;
}

TEST(WaypointPath, NumbersPointsAsTheyWereGiven) {
  const WaypointLine line{{{0.0, 0.0}, {0.0, 0.0}, {30.0, 0.0}, {30.0, 30.0}}};
  ASSERT_EQ(through(line).tight_bends.size(), 1u);
  EXPECT_EQ(through(line).tight_bends[0].waypoint, 2u);
}

TEST(WaypointPath, GetsOnInStepsBelowAMillimetre) {
  WaypointLine line;
  for (int i = 0; i <= 3000; ++i) line.points.emplace_back(0.4e-3 * i, 0.0);
  EXPECT_NEAR(through(line).path.back().s, 1.2, 1e-3);
}

TEST(WaypointPath, EndsWithTheHeadingThatIsWishedForWhereTheVehicleCan) {
  WaypointLine line{{{0.0, 0.0}, {5.0, 0.0}, {10.0, 0.0}}};
  line.end_heading = 0.1;
  EXPECT_NEAR(through(line).path.back().heading, 0.1, 1e-9);
  EXPECT_EQ(through(line).end_turn, 0.0);
  EXPECT_TRUE(isDriven(through(line).path));
}

TEST(WaypointPath, LeavesAnEndHeadingThatTheVehicleCannotTurnTo) {
  for (const double heading : {M_PI / 2.0, M_PI, -2.0, 0.5}) {
    WaypointLine line{{{0.0, 0.0}, {5.0, 0.0}, {5.5, 0.0}}};
    line.end_heading = heading;
    const WaypointPath result = through(line);
    EXPECT_NEAR(result.path.back().heading, 0.0, 1e-9) << heading;
    EXPECT_NEAR(result.end_turn, heading, 1e-9);
    EXPECT_TRUE(result.tight_bends.empty()) << heading;
    EXPECT_EQ(result.path.back().direction, Direction::kForward);
  }
}

TEST(WaypointPath, RefusesPointsThatAreNoPath) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(lineRefusal({{{1.0, 2.0}}, {}}).find("at least 2"), std::string::npos);
  EXPECT_NE(lineRefusal({{{1.0, 2.0}, {nan, 0.0}}, {}}).find("way_point[1] is not finite"), std::string::npos);
  EXPECT_NE(lineRefusal({{{1.0, 2.0}, {1.0, 2.0}}, {}}).find("2 points, all in one place"), std::string::npos);
  EXPECT_NE(lineRefusal({{{0.0, 0.0}, {1e9, 0.0}}, {}}).find("too long"), std::string::npos);
  EXPECT_NE(lineRefusal({{{-1e308, 0.0}, {1e308, 0.0}}, {}}).find("too long"), std::string::npos);
}

TEST(WaypointPath, RefusesHeadingsThatAreNoneOfAVehicle) {
  const std::vector<Point2d> points = {{0.0, 0.0}, {5.0, 0.0}};
  EXPECT_NE(lineRefusal({points, {0.0}}).find("heading has 1 elements"), std::string::npos);
  EXPECT_NE(lineRefusal({points, {0.0, std::nan("")}}).find("heading[1] is not finite"), std::string::npos);
  EXPECT_NE(lineRefusal({points, {M_PI / 2, M_PI / 2}}).find("across the way"), std::string::npos);
  EXPECT_EQ(lineRefusal({points, {0.3, -0.2}}), "");
}

TEST(WaypointPath, TakesALineThatTurnsBackOnItselfAsACorner) {
  const WaypointPath result = through({{{0.0, 0.0}, {10.0, 0.0}, {0.0, 0.0}}, {}});
  ASSERT_EQ(result.tight_bends.size(), 1u);
  EXPECT_NEAR(std::abs(result.tight_bends[0].corner), M_PI, 1e-9);
  for (const ReferencePoint& point : result.path) EXPECT_TRUE(point.pose().isFinite() && std::isfinite(point.kappa));
}

TEST(WaypointPath, IsGivenUpWhenItIsCancelled) {
  const CancelSource cancel;
  const WaypointLine line{{{0.0, 0.0}, {50000.0, 0.0}}};
  EXPECT_NO_THROW(pathThrough(line, VehicleParams(), 0.5, 5.0, {}, cancel.token()));
  cancel.cancel();
  EXPECT_THROW(pathThrough(line, VehicleParams(), 0.5, 5.0, {}, cancel.token()), Cancelled);
}

}  // namespace
}  // namespace external_command
