// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <random>

#include "external_command/core/error.h"
#include "support/refusal.h"

namespace external_command {
namespace {

using Points = std::vector<Point2d>;

const Points kSquare = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

/// ```
///  +--+  +--+
///  |  |  |  |
///  |  +--+  |
///  +--------+
/// ```
const Points kU = {{0, 0}, {30, 0}, {30, 20}, {20, 20}, {20, 10}, {10, 10}, {10, 20}, {0, 20}};

/// The text that a polygon of these points is refused with; empty where it is taken.
std::string refusal(const Points& points) {
  return refusalOf([&] { Polygon(points, "roi"); });
}

void expectRefusal(const Points& points, const std::string& what) {
  const std::string why = refusal(points);
  EXPECT_EQ(why.find("roi"), 0u) << why;
  EXPECT_NE(why.find(what), std::string::npos) << "the answer was: \"" << why << "\"";
}

TEST(Polygon, IsCounterClockwiseWhateverItWasGivenAs) {
  Points clockwise = kU;
  std::reverse(clockwise.begin(), clockwise.end());
  for (const Points& points : {kU, clockwise}) {
    const Polygon polygon(points, "roi");
    EXPECT_NEAR(polygon.area(), 500.0, 1e-9);
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.points().size(); ++i) {
      twice += cross(polygon.points()[i], polygon.points()[(i + 1) % polygon.points().size()]);
    }
    EXPECT_NEAR(twice, 1000.0, 1e-9);
  }
}

TEST(Polygon, DropsPointsThatRepeatTheirNeighbour) {
  const Polygon polygon({{0, 0}, {0, 0}, {10, 0}, {10, 0.0004}, {10, 10}, {0, 10}, {0, 0}}, "roi");
  EXPECT_EQ(polygon.points().size(), 4u);
}

TEST(Polygon, KeepsItsDigitsFarFromTheOrigin) {
  Points points;
  for (const Point2d& point : kSquare) points.push_back(point + Point2d(596575, 4137624));
  const Polygon polygon(points, "roi");
  EXPECT_NEAR(polygon.area(), 100.0, 1e-6);
  EXPECT_TRUE(polygon.contains({596580, 4137629}));
  EXPECT_FALSE(polygon.contains({596586, 4137629}));
}

TEST(Polygon, RefusesWhatIsNoPolygon) {
  expectRefusal({}, "has 0 distinct vertices");
  expectRefusal({{0, 0}, {1, 0}}, "at least 3 are needed");
  expectRefusal({{0, 0}, {1, 0}, {0, 0}, {1, 0.0001}}, "");
  expectRefusal({{0, 0}, {10, 0}, {20, 0}}, "");
  expectRefusal({{0, 0}, {1, 0}, {1, 1e-5}, {0, 1e-5}}, "");
}

TEST(Polygon, RefusesVerticesThatAreNoPlace) {
  expectRefusal({{0, 0}, {10, std::nan("")}, {10, 10}}, "vertex 1 is not finite");
  expectRefusal({{0, 0}, {10, 0}, {HUGE_VAL, 10}}, "vertex 2 is not finite");
  expectRefusal({{0, 0}, {10, 0}, {1e300, 1e300}}, "vertex 2 lies beyond");
}

TEST(Polygon, SaysWhereItCrossesItself) {
  expectRefusal({{0, 0}, {10, 10}, {10, 0}, {0, 10}}, "from vertex 0 (0.00, 0.00) meets the edge from vertex 2");
  expectRefusal({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}, "crosses or touches itself");
  expectRefusal({{0, 0}, {10, 0}, {10, 10}, {10, 5}, {20, 5}}, "crosses or touches itself");
}

/// A star drawn in one go turns to the left at every corner, and yet crosses itself.
TEST(Polygon, RefusesAPentagram) {
  Points points;
  for (int i = 0; i < 5; ++i) points.push_back(10.0 * unitVector(i * 4.0 * M_PI / 5.0));
  expectRefusal(points, "crosses or touches itself");
}

/// Once around is simple, twice around is not, though it turns to the left all the way.
TEST(Polygon, RefusesASpiralOfTwoRounds) {
  Points points;
  for (int i = 0; i < 16; ++i) points.push_back((10.0 + 0.1 * i) * unitVector(i * M_PI / 4.0));
  expectRefusal(points, "crosses or touches itself");
  points.resize(8);
  EXPECT_EQ(refusal(points), "");
}

TEST(Polygon, RefusesALargeTangleInTime) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-100.0, 100.0);
  Points points;
  for (int i = 0; i < 20000; ++i) points.emplace_back(place(random), place(random));
  const auto start = std::chrono::steady_clock::now();
  expectRefusal(points, "crosses or touches itself");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Polygon, ContainsItsInsideAndItsBorder) {
  const Polygon u(kU, "roi");
  EXPECT_TRUE(u.contains({5, 15}));
  EXPECT_TRUE(u.contains({15, 5}));
  EXPECT_FALSE(u.contains({15, 15}));
  EXPECT_FALSE(u.contains({-1, 5}));
  for (std::size_t i = 0; i < kU.size(); ++i) {
    const Point2d a = kU[i], b = kU[(i + 1) % kU.size()];
    for (double share = 0.0; share < 1.0; share += 0.1) EXPECT_TRUE(u.contains(a + share * (b - a)));
  }
}

/// Teeth of 1 km, side by side at 45 degrees: the boxes of all edges overlap.
Points slantingComb(int teeth) {
  const Point2d along = unitVector(M_PI / 4.0), across = unitVector(-M_PI / 4.0);
  Points points;
  for (int i = 0; i <= 2 * teeth; ++i) points.push_back(0.05 * i * across + (i % 2) * 1000.0 * along);
  points.push_back(points.back() - 5.0 * along);
  points.push_back(-5.0 * along);
  return points;
}

TEST(Polygon, TakesAnIntricateOneInAMoment) {
  const std::clock_t start = std::clock();
  EXPECT_EQ(refusal(slantingComb(50000)), "");
  EXPECT_LT(std::clock() - start, 10 * CLOCKS_PER_SEC);
}

/// Teeth that all but reach its middle, so that every row and column crosses all of them.
TEST(Polygon, TakesAStarOfManyTeethInAMoment) {
  Points points;
  for (int i = 0; i < 100000; ++i) points.push_back((i % 2 == 0 ? 100.0 : 1000.0) * unitVector(i * M_PI / 50000.0));
  const std::clock_t start = std::clock();
  EXPECT_EQ(refusal(points), "");
  EXPECT_LT(std::clock() - start, 10 * CLOCKS_PER_SEC);
}

double distance(const Point2d& point, const Point2d& a, const Point2d& b) {
  return (point - nearestOnSegment(point, a, b)).norm();
}

/// Whether any two edges meet, by comparing all of them.
bool meetsItself(const Points& points) {
  constexpr double kTouching = 1e-6;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2d &a = points[i], &b = points[(i + 1) % n];
    if (distance(a, b, points[(i + 2) % n]) < kTouching || distance(points[(i + 2) % n], a, b) < kTouching) return true;
    for (std::size_t j = i + 2; j < n && (j + 1) % n != i; ++j) {
      const Point2d &c = points[j], &d = points[(j + 1) % n];
      const double nearest = std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
      const bool crosses = (cross(b - a, c - a) > 0.0) != (cross(b - a, d - a) > 0.0) &&
                           (cross(d - c, a - c) > 0.0) != (cross(d - c, b - c) > 0.0);
      if (nearest < kTouching || crosses) return true;
    }
  }
  return false;
}

class RandomPolygons {
 public:
  /// Corners of a coarse lattice: they touch, repeat and overlap in every way.
  Points ofLattice() {
    Points points;
    const int n = whole(3, 9), size = whole(2, 6);
    while (static_cast<int>(points.size()) < n) {
      const Point2d point(whole(0, size), whole(0, size));
      const bool repeats = !points.empty() && (point == points.back() || point == points.front());
      if (!repeats) points.push_back(point);
    }
    return points;
  }

  /// A star, one of whose vertices is brought near to an edge or vertex elsewhere.
  Points nearlyTouching() {
    Points points;
    const int n = whole(6, 40);
    for (int i = 0; i < n; ++i) points.push_back(real(1.0, 20.0) * unitVector(2.0 * M_PI * i / n));
    const int vertex = whole(0, n - 1), edge = (vertex + whole(2, n - 3)) % n;
    const Point2d &a = points[static_cast<std::size_t>(edge)], &b = points[static_cast<std::size_t>((edge + 1) % n)];
    const double share = whole(0, 3) == 0 ? 0.0 : real(0.0, 1.0), gaps[] = {0.0, 2e-7, 5e-6, 1e-2};
    const Point2d along = (b - a).normalized(), across(-along.y(), along.x());
    points[static_cast<std::size_t>(vertex)] = a + share * (b - a) + gaps[whole(0, 3)] * across;
    return points;
  }

  Points turned(Points points) {
    const Point2d offset = whole(0, 1) * Point2d(596575.0, 4137624.0);
    const Pose2d frame{offset.x(), offset.y(), whole(0, 3) * real(0.0, 2.0)};
    for (Point2d& point : points) point = compose(frame, {point.x(), point.y(), 0.0}).position();
    return points;
  }

 private:
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  std::mt19937 random_{1};
};

TEST(Polygon, IsRefusedExactlyWhereTwoOfItsEdgesMeet) {
  RandomPolygons random;
  int meeting = 0, simple = 0;
  for (int round = 0; round < 20000; ++round) {
    const Points points = random.turned(round % 2 == 0 ? random.ofLattice() : random.nearlyTouching());
    const bool meets = meetsItself(points);
    (meets ? meeting : simple) += 1;
    const bool is_refused = refusal(points).find("crosses or touches itself") != std::string::npos;
    ASSERT_EQ(is_refused, meets) << "round " << round;
  }
  EXPECT_GT(meeting, 3000);
  EXPECT_GT(simple, 3000);
}

TEST(Polygon, IsTheSameElsewhere) {
  const Polygon u(kU, "u"), moved = u.movedBy({1e6, -3.0});
  EXPECT_EQ(moved.area(), u.area());
  EXPECT_EQ(moved.box().max, u.box().max + Point2d(1e6, -3.0));
  EXPECT_TRUE(moved.contains({1e6 + 15.0, 2.0}));
  EXPECT_FALSE(moved.contains({1e6 + 15.0, 12.0}));
}

TEST(Polygon, ContainsWhatTheWindingNumberSays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> radius(5.0, 20.0), place(-25.0, 25.0);
  for (int round = 0; round < 50; ++round) {
    Points points;
    for (int i = 0; i < 12; ++i) points.push_back(radius(random) * unitVector(i * M_PI / 6.0));
    const Polygon star(points, "roi");
    for (int i = 0; i < 100; ++i) {
      const Point2d point(place(random), place(random));
      double turn = 0.0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        turn += angleBetween(headingOf(points[k] - point), headingOf(points[(k + 1) % points.size()] - point));
      }
      EXPECT_EQ(star.contains(point), std::abs(turn) > M_PI) << "round " << round;
    }
  }
}

TEST(Polygon, MeasuresTheDistanceToItsBorderFromBothSides) {
  const Polygon square(kSquare, "roi");
  EXPECT_NEAR(square.distanceToBorder({5, 8}), 2.0, 1e-12);
  EXPECT_NEAR(square.distanceToBorder({13, 14}), 5.0, 1e-12);
  EXPECT_EQ(square.distanceToBorder({10, 3}), 0.0);
}

TEST(Polygon, KnowsItsBox) {
  const BoundingBox box = Polygon({{3, 1}, {7, 5}, {2, 9}}, "roi").box();
  EXPECT_EQ(box.min, Point2d(2, 1));
  EXPECT_EQ(box.max, Point2d(7, 9));
}

TEST(NearestOnSegment, StaysOnTheSegment) {
  EXPECT_EQ(nearestOnSegment({5, 5}, {0, 0}, {10, 0}), Point2d(5, 0));
  EXPECT_EQ(nearestOnSegment({-5, 5}, {0, 0}, {10, 0}), Point2d(0, 0));
  EXPECT_EQ(nearestOnSegment({15, 5}, {0, 0}, {10, 0}), Point2d(10, 0));
  EXPECT_EQ(nearestOnSegment({15, 5}, {3, 3}, {3, 3}), Point2d(3, 3));
}

}  // namespace
}  // namespace external_command
