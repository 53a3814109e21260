// SPDX-License-Identifier: Apache-2.0
#include "external_command/motion/collision_checker.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/motion/reeds_shepp.h"
#include "support/parking_worlds.h"
#include "support/reference_clearance.h"
#include "support/refusal.h"

namespace external_command {
namespace {

/// Random poses in a square of `size` [m] around `centre`.
std::vector<Pose2d> poses(unsigned seed, int count, const Point2d& centre, double size) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Pose2d> result;
  for (int i = 0; i < count; ++i) {
    result.push_back({centre.x() + size * unit(random), centre.y() + size * unit(random), M_PI * unit(random)});
  }
  return result;
}

/// Random convex, concave and thin polygons within 15 m of `centre`.
std::vector<Polygon> clutter(unsigned seed, int count, const Point2d& centre) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Polygon> result;
  for (int i = 0; i < count; ++i) {
    const Point2d middle = centre + 30.0 * Point2d(unit(random) - 0.5, unit(random) - 0.5);
    const int corners = 3 + static_cast<int>(5 * unit(random));
    std::vector<Point2d> points;
    for (int c = 0; c < corners; ++c) {
      points.push_back(middle + (0.05 + 2.5 * unit(random)) * unitVector(2.0 * M_PI * c / corners));
    }
    result.emplace_back(points, "clutter");
  }
  return result;
}

void expectSameAsReference(const Region& region, double margin, const std::vector<Pose2d>& where) {
  const VehicleParams vehicle = smallCar();
  const CollisionChecker checker(vehicle, margin, region);
  for (const Pose2d& pose : where) {
    const double distance = referenceClearance(vehicle, pose, region);
    ASSERT_NEAR(checker.clearance(pose, 5.0), std::min(distance, 5.0), 1e-6) << pose.x << " " << pose.y;
    if (std::abs(distance - margin) < 1e-6) continue;
    const bool is_free = distance > 0.0 && distance > margin;
    ASSERT_EQ(checker.isFree(pose), is_free) << pose.x << " " << pose.y << " " << pose.heading << ": " << distance;
    ASSERT_EQ(checker.collisionAt(pose).has_value(), !is_free);
  }
}

TEST(CollisionChecker, AgreesWithPlainGeometryAmongPolygons) {
  for (const double margin : {0.0, 0.01, 0.3}) {
    Region::Parts parts;
    parts.non_drivable = clutter(1, 15, {0, 0});
    expectSameAsReference(Region(parts), margin, poses(2, 1500, {0, 0}, 18.0));
  }
}

TEST(CollisionChecker, AgreesWithPlainGeometryInsideAConcaveBorder) {
  Region::Parts parts;
  parts.drivable = Polygon({{-12, -12}, {12, -12}, {12, 12}, {2, 12}, {0, -4}, {-2, 12}, {-12, 12}}, "border");
  parts.non_drivable = clutter(3, 4, {0, 0});
  expectSameAsReference(Region(parts), 0.1, poses(4, 1500, {0, 0}, 16.0));
}

TEST(CollisionChecker, KeepsItsPrecisionFarFromTheOrigin) {
  const Point2d far(4.5e7, -5.5e7);
  Region::Parts parts;
  parts.non_drivable = clutter(5, 15, far);
  expectSameAsReference(Region(parts), 0.05, poses(6, 500, far, 18.0));
}

TEST(CollisionChecker, SeesAVehicleInsideALargeObstacle) {
  Region::Parts parts;
  parts.non_drivable.push_back(box({0, 0}, 100.0, 100.0));
  const CollisionChecker checker(smallCar(), 0.0, Region(parts));
  EXPECT_FALSE(checker.isFree({0, 0, 1}));
  EXPECT_EQ(checker.clearance({0, 0, 1}), 0.0);
  EXPECT_TRUE(checker.isFree({60, 0, 1}));
}

TEST(CollisionChecker, SeesAnObstacleThatLiesWhollyUnderTheVehicle) {
  Region::Parts parts;
  parts.non_drivable.push_back(box({1.0, 0.2}, 0.02, 0.02));
  const CollisionChecker checker(smallCar(), 0.0, Region(parts));
  EXPECT_FALSE(checker.isFree({0, 0, 0}));
  EXPECT_TRUE(checker.isFree({0, 2, 0}));
}

TEST(CollisionChecker, IsFreeEverywhereWithoutAnyObstacle) {
  const CollisionChecker checker(smallCar(), 0.5, Region());
  EXPECT_TRUE(checker.isFree({1e6, 3.0, 2.0}));
  EXPECT_EQ(checker.clearance({0, 0, 0}, 7.0), 7.0);
}

TEST(CollisionChecker, KeepsTheRearAxleInItsBounds) {
  Region::Parts parts;
  parts.axle_bounds = BoundingBox{{0, 0}, {10, 10}};
  const CollisionChecker checker(smallCar(), 0.0, Region(parts));
  EXPECT_TRUE(checker.isFree({0.1, 0.1, M_PI}));  // the footprint may leave them
  const auto collision = checker.collisionAt({-0.5, 5.0, 0.0});
  ASSERT_TRUE(collision);
  EXPECT_EQ(collision->kind, Collision::Kind::kAxleBounds);
  EXPECT_NEAR(collision->depth, 0.5, 1e-9);
}

TEST(CollisionChecker, NamesTheObstacleAndTheDepth) {
  const VehicleParams vehicle = smallCar();
  Region::Parts parts;
  parts.drivable = Polygon(box({0, 0}, 40.0, 40.0).points(), "the yard");
  parts.non_drivable.push_back(box({10, 10}, 1.0, 1.0));
  parts.non_drivable.push_back(Polygon(box({0, -2.0}, 8.0, 2.0).points(), "parking space p7"));  // up to y = -1
  const CollisionChecker checker(vehicle, 0.0, Region(parts));
  const double y = -1.0 + vehicle.width / 2.0 - 0.12;
  const auto collision = checker.collisionAt({0, y, 0});
  ASSERT_TRUE(collision);
  EXPECT_EQ(collision->description(), "overlaps parking space p7 by 0.12 m");
  EXPECT_NEAR(collision->depth, 0.12, 2e-3);
  EXPECT_FALSE(checker.collisionAt({0, y + 0.13, 0}));
  const auto outside = checker.collisionAt({19.0, 0, 0});
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->description().find("sticks out of the yard by "), 0u) << outside->description();
  EXPECT_NEAR(outside->depth, 19.0 + vehicle.wheelbase + vehicle.front_overhang - 20.0, 2e-3);
}

TEST(CollisionChecker, FindsTheSmallestClearanceOfAPath) {
  Region::Parts parts;
  parts.non_drivable.push_back(box({5.0, 3.0}, 1.0, 2.0));  // its lower side at y = 2
  const CollisionChecker checker(smallCar(), 0.0, Region(parts));
  const Path path = sampleArcs({-10, 0, 0}, {{20.0, 0.0}}, 0.1);
  EXPECT_NEAR(checker.minClearance(path), 2.0 - smallCar().width / 2.0, 1e-9);
}

TEST(CollisionChecker, TellsHowDeepAFootprintLies) {
  Region::Parts parts;
  parts.non_drivable = {Polygon({{-500, -500}, {500, -500}, {500, 500}, {-500, 500}}, "a lake")};
  const auto deep = CollisionChecker(smallCar(), 0.1, Region(parts)).collisionAt({0, 0, 0});
  ASSERT_TRUE(deep);
  EXPECT_EQ(deep->extent(), "by more than 64.00 m");
  parts.non_drivable = {Polygon({{-500, -500}, {500, -500}, {500, -0.5}, {-500, -0.5}}, "a shore")};
  const auto shallow = CollisionChecker(smallCar(), 0.1, Region(parts)).collisionAt({0, 0, 0});
  ASSERT_TRUE(shallow);
  EXPECT_EQ(shallow->extent().find("by 0."), 0u) << shallow->extent();
}

TEST(CollisionChecker, RefusesANegativeMargin) {
  EXPECT_THROW(CollisionChecker(smallCar(), -0.1, Region()), InvalidParameter);
  EXPECT_THROW(CollisionChecker(smallCar(), std::nan(""), Region()), InvalidParameter);
  EXPECT_NO_THROW(CollisionChecker(smallCar(), 0.1, Region()));
}

Polygon post(const Point2d& middle, double radius, int corners) {
  std::vector<Point2d> points;
  for (int i = 0; i < corners; ++i) points.push_back(middle + radius * unitVector(2.0 * M_PI * i / corners));
  return Polygon(points, "post");
}

TEST(CollisionChecker, AgreesWithPlainGeometryAmongFinelyDrawnObstacles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const auto& [radius, corners] : {std::pair{0.02, 50}, {0.3, 100}, {0.3, 7}, {1.5, 300}, {4.0, 900}}) {
    Region::Parts parts;
    for (int i = 0; i < 8; ++i)
      parts.non_drivable.push_back(post({15.0 * unit(random), 15.0 * unit(random)}, radius, corners));
    parts.drivable = post({0.0, 0.0}, 20.0, 500);
    expectSameAsReference(Region(parts), 0.1, poses(4, 80, {0.0, 0.0}, 20.0));
  }
}

/// Posts on a square of `size` [m] with `edges` in all.
Region posts(double size, int corners, int edges, const RegionLimits& limits) {
  Region::Parts parts;
  const int side = static_cast<int>(std::sqrt(edges / corners));
  for (int i = 0; i < side * side; ++i) {
    parts.non_drivable.push_back(post({size * (i % side) / side, size * (i / side) / side}, 0.3, corners));
  }
  parts.limits = limits;
  return Region(std::move(parts));
}

TEST(CollisionChecker, TakesInHalfAMillionShortEdgesByDefault) {
  const VehicleParams car = smallCar();
  for (const int corners : {100, 1000}) {
    const Region region = posts(400.0, corners, 500'000, {});
    const CollisionChecker checker(car, 0.1, region);
    const double beside = 0.3 + 0.5 * car.width;  // the first post stands at the origin
    EXPECT_TRUE(checker.isFree({0.0, -beside - 0.11, 0.0}));
    EXPECT_FALSE(checker.isFree({0.0, -beside - 0.09, 0.0}));
  }
}

TEST(CollisionChecker, JoinsMoreOfTheEdgesWhereTheyWouldTakeTooMuchMemory) {
  const RegionLimits few{500'000, 200'000}, fewer{500'000, 1'000};
  const auto taken = [](const RegionLimits& limits) {
    return refusalOf([&] { const CollisionChecker checker(smallCar(), 0.1, posts(40.0, 100, 20'000, limits)); });
  };
  EXPECT_EQ(taken({}), "");
  EXPECT_EQ(taken(few), "");
  EXPECT_NE(taken(fewer).find("short ones side by side counted as one"), std::string::npos);
  Region::Parts parts;
  parts.non_drivable = posts(40.0, 100, 20'000, {}).nonDrivable();
  parts.limits = few;
  expectSameAsReference(Region(parts), 0.1, poses(5, 40, {20.0, 20.0}, 25.0));
}

std::string regionRefusal(const RegionLimits& limits) {
  Region::Parts parts;
  parts.non_drivable = clutter(1, 50, {0.0, 0.0});
  parts.limits = limits;
  return refusalOf([&] { const CollisionChecker checker(smallCar(), 0.1, Region(parts)); });
}

TEST(CollisionChecker, RefusesARegionBeyondItsLimitsAndNamesTheParameter) {
  EXPECT_EQ(regionRefusal({}), "");
  EXPECT_NE(regionRefusal({20, 1000000}).find("more than 20 edges (~free_space/max_edges)"), std::string::npos);
  EXPECT_NE(
      regionRefusal({1000, 1000}).find("more than 1000 in sum over the cells near them (~free_space/max_near_edges)"),
      std::string::npos);
  EXPECT_NO_THROW(RegionLimits().validate());
  EXPECT_THROW((RegionLimits{0, 1000}.validate()), InvalidParameter);
  EXPECT_THROW((RegionLimits{1000, 0}.validate()), InvalidParameter);
}

TEST(CollisionChecker, IsNotMadeToTheEndWhenItIsCancelled) {
  const CancelSource cancel;
  cancel.cancel();
  Region::Parts parts;
  parts.non_drivable = clutter(1, 50, {0.0, 0.0});
  EXPECT_THROW(CollisionChecker(smallCar(), 0.1, Region(parts), cancel.token().checkpoint()), Cancelled);
}

/// 40 x 30 cells of 0.5 m, all free but a few random ones, some of them unknown.
OccupancyGrid randomGrid(unsigned seed, double heading) {
  OccupancyGrid grid;
  grid.resolution = 0.5;
  grid.width = 40;
  grid.height = 30;
  grid.origin = {3.0, -7.0, heading};
  std::mt19937 random(seed);
  for (std::uint32_t i = 0; i < grid.width * grid.height; ++i) {
    grid.cells.push_back(random() % 60 == 0 ? (random() % 2 == 0 ? -1 : 80) : static_cast<std::int8_t>(random() % 50));
  }
  return grid;
}

TEST(CollisionChecker, AgreesWithPlainGeometryOnTurnedGrids) {
  for (const double heading : {0.0, 0.6, -2.3}) {
    for (const auto& [unknown, outside] : {std::pair{true, true}, {true, false}, {false, true}, {false, false}}) {
      Region::Parts parts;
      parts.grid = randomGrid(8, heading);
      parts.grid->unknown_is_blocked = unknown;
      parts.grid->outside_is_blocked = outside;
      const Pose2d middle = compose(parts.grid->origin, {10.0, 7.5, 0.0});
      expectSameAsReference(Region(parts), 0.1, poses(9, 40, middle.position(), 12.0));
    }
  }
}

TEST(CollisionChecker, SeesAGridAndPolygonsTogether) {
  Region::Parts parts;
  parts.grid = randomGrid(10, 0.4);
  parts.non_drivable = clutter(11, 5, {10, 5});
  expectSameAsReference(Region(parts), 0.05, poses(12, 40, {10, 5}, 12.0));
}

TEST(CollisionChecker, SeesOfAGridWhatLiesWithinTheBorder) {
  for (const double heading : {0.0, 0.7}) {
    Region::Parts parts;
    parts.grid = randomGrid(13, heading);
    parts.drivable = Polygon({{4, -3}, {14, -2}, {13, 6}, {5, 5}}, "a yard");
    expectSameAsReference(Region(parts), 0.05, poses(14, 60, {9, 1}, 6.0));
  }
}

TEST(Region, RefusesAGridThatDoesNotFitItsSize) {
  Region::Parts parts;
  parts.grid = randomGrid(1, 0.0);
  EXPECT_NO_THROW(Region{parts});
  parts.grid->cells.pop_back();
  EXPECT_THROW(Region{parts}, InvalidRequest);
  parts.grid = randomGrid(1, 0.0);
  parts.grid->resolution = 0.0;
  EXPECT_THROW(Region{parts}, InvalidRequest);
  parts.grid = randomGrid(1, std::nan(""));
  EXPECT_THROW(Region{parts}, InvalidRequest);
  parts.grid = randomGrid(1, 0.0);
  parts.grid->blocked_from = 0;
  EXPECT_THROW(Region{parts}, InvalidRequest);
}

TEST(GridFault, IsNoneForAGridThatFitsItsSizeWithoutItsCells) {
  OccupancyGrid outline = randomGrid(1, 0.0);
  const std::size_t cells = outline.cells.size();
  outline.cells.clear();
  EXPECT_EQ(gridFault(outline, cells), "");
}

TEST(GridFault, SaysWhatIsWrongAndHowMuch) {
  const OccupancyGrid good = randomGrid(1, 0.0);
  EXPECT_EQ(gridFault(good, 7), "the grid holds 7 values; its size of 40 x 30 needs 1200");
  OccupancyGrid bad = good;
  bad.resolution = std::nan("");
  EXPECT_EQ(gridFault(bad, 1200), "the grid's resolution is nan m; it must lie in [0.001, 100]");
  bad = good;
  bad.origin.x = HUGE_VAL;
  EXPECT_EQ(gridFault(bad, 1200), "the grid's origin is not finite");
  bad = good;
  bad.width = 0;
  EXPECT_EQ(gridFault(bad, 0), "the grid has 0 x 30 cells; it must have 1 to 64000000");
}

TEST(Region, RefusesEmptyAxleBounds) {
  Region::Parts parts;
  parts.axle_bounds = BoundingBox{{0, 0}, {10, 0}};
  EXPECT_THROW(Region{parts}, InvalidRequest);
}

}  // namespace
}  // namespace external_command
