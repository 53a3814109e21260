// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "external_command/core/error.h"

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
  try {
    Polygon(points, "roi");
  } catch (const InvalidRequest& error) {
    return error.what();
  }
  return "";
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

TEST(Polygon, TakesAnIntricateOneOfAThousandVertices) { EXPECT_NO_THROW(Polygon(slantingComb(500), "roi")); }

TEST(Polygon, RefusesOneTooIntricateToCheckInAMoment) {
  EXPECT_NE(refusal(slantingComb(5000)).find("roi is too intricate"), std::string::npos);
}

TEST(Polygon, RefusesMoreEdgePairsThanTheLimitAndNamesItsParameter) {
  const PolygonLimit limit{1000, "~requests/max_edge_pairs"};
  EXPECT_NO_THROW(Polygon(slantingComb(10), "roi", limit));
  try {
    Polygon(slantingComb(100), "roi", limit);
    FAIL() << "it was taken";
  } catch (const InvalidRequest& error) {
    EXPECT_NE(std::string(error.what()).find("more than 1000 pairs lie side by side (~requests/max_edge_pairs)"),
              std::string::npos)
        << error.what();
  }
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
