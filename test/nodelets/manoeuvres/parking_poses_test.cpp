// SPDX-License-Identifier: Apache-2.0
#include "nodelets/manoeuvres/parking_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace external_command {
namespace {

constexpr double kMargin = 0.1;  // [m]

Polygon box(double x0, double y0, double x1, double y1) {
  return Polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, "a box");
}

/// A space below a lane along x, `width` wide about x = 0 and `length` long, entered downwards from y = 0.
ParkingSpace spaceOf(double width, double length) {
  return {"p", box(-width / 2.0, -length, width / 2.0, 0.0), -M_PI / 2.0, {}};
}

/// With neighbours to the left and right, whose borders are these.
CollisionChecker between(double left, double right) {
  Region::Parts parts;
  parts.non_drivable = {box(left - 3.0, -6.0, left, 0.0), box(right, -6.0, right + 3.0, 0.0)};
  return CollisionChecker(VehicleParams(), kMargin, Region(parts));
}

class SpaceBesideALane : public testing::Test {
 protected:
  ParkingSpot spotOf(double width, double length) {
    space_ = std::make_unique<ParkingSpace>(spaceOf(width, length));
    return {*space_, vehicle, kMargin, params};
  }

  VehicleParams vehicle;
  ParkingParams params;

 private:
  std::unique_ptr<ParkingSpace> space_;
};

TEST_F(SpaceBesideALane, HoldsTheVehicleInItsMiddle) {
  const ParkingSpot spot = spotOf(2.7, 5.5);
  const std::vector<Pose2d> poses = spot.poses();
  ASSERT_EQ(poses.size(), 2u);
  for (const Pose2d& pose : poses) {
    const auto corners = footprintAt(vehicle, pose, 0.0);
    const Point2d middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4.0;
    EXPECT_NEAR((middle - Point2d(0.0, -2.75)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(spot.offsetOf(pose).position().norm(), 0.0, 1e-9);
  }
  EXPECT_NEAR(std::abs(angleBetween(poses[0].heading, poses[1].heading)), M_PI, 1e-9);
}

TEST_F(SpaceBesideALane, LetsTheVehicleStickOutOnlyTowardsTheLane) {
  const ParkingSpot spot = spotOf(2.7, 4.0);
  for (const Pose2d& pose : spot.poses()) {
    for (const Point2d& corner : footprintAt(vehicle, pose, kMargin)) EXPECT_GT(corner.y(), -4.0);
  }
}

TEST_F(SpaceBesideALane, TakesTheMiddleWhereThatIsFree) {
  const ParkingSpot spot = spotOf(2.7, 5.5);
  const std::vector<Pose2d> free = spot.freePoses(between(-1.35, 1.35));
  ASSERT_EQ(free.size(), 2u);
  for (const Pose2d& pose : free) EXPECT_LT(spot.offsetOf(pose).position().norm(), 1e-9);
}

TEST_F(SpaceBesideALane, MovesAsideNoMoreThanItMust) {
  const ParkingSpot spot = spotOf(2.7, 5.5);
  const CollisionChecker neighbours = between(-1.0, 1.6);
  const std::vector<Pose2d> free = spot.freePoses(neighbours);
  ASSERT_EQ(free.size(), 2u);
  for (const Pose2d& pose : free) {
    EXPECT_TRUE(neighbours.isFree(pose));
    EXPECT_NEAR(spot.offsetOf(pose).position().norm(), 0.13, 0.03);
    EXPECT_NEAR(pose.x, 0.13, 0.03);
    EXPECT_TRUE(spot.placeFor({pose}).contains({footprintAt(vehicle, pose, kMargin)[0]}));
  }
}

TEST_F(SpaceBesideALane, TurnsWhereThatMakesRoom) {
  // Askew neighbours, the gap between them just wide enough for vehicle and margin.
  const double turn = 0.04;
  const auto moved = [&](double x0, double x1) {
    std::vector<Point2d> points;
    for (const auto& [x, y] : {std::pair(x0, -5.0), {x1, -5.0}, {x1, 5.0}, {x0, 5.0}}) {
      points.push_back(compose({0.0, -2.75, turn}, {x, y, 0.0}).position());
    }
    return Polygon(points, "a neighbour");
  };
  Region::Parts parts;
  parts.non_drivable = {moved(-4.0, -1.11), moved(1.11, 4.0)};
  const CollisionChecker neighbours(vehicle, kMargin, Region(parts));
  const ParkingSpot spot = spotOf(2.7, 5.5);
  const std::vector<Pose2d> free = spot.freePoses(neighbours);
  ASSERT_FALSE(free.empty());
  EXPECT_NEAR(spot.offsetOf(free[0]).heading, turn, 0.02);
}

TEST_F(SpaceBesideALane, KeepsToItsTolerances) {
  const ParkingSpot spot = spotOf(2.7, 5.5);
  EXPECT_TRUE(spot.freePoses(between(-0.85, 2.0)).empty()) << "0.25 m aside";
  EXPECT_TRUE(spot.freePoses(between(-1.05, 1.05)).empty()) << "too narrow anywhere";
  params.position_tolerance = 0.3;
  EXPECT_FALSE(spotOf(2.7, 5.5).freePoses(between(-0.85, 2.0)).empty());
}

TEST_F(SpaceBesideALane, ParksInTheDirectionThatIsWished) {
  params.direction = ParkingDirection::kNoseIn;
  ASSERT_EQ(spotOf(2.7, 5.5).poses().size(), 1u);
  EXPECT_NEAR(spotOf(2.7, 5.5).poses()[0].heading, -M_PI / 2.0, 1e-9);
  params.direction = ParkingDirection::kBackingIn;
  EXPECT_NEAR(spotOf(2.7, 5.5).poses()[0].heading, M_PI / 2.0, 1e-9);
}

TEST_F(SpaceBesideALane, TellsWhatASmallSpaceLacks) {
  EXPECT_FALSE(spotOf(2.7, 5.5).isSmall());
  EXPECT_TRUE(spotOf(2.7, 4.0).isSmall());
  EXPECT_EQ(spotOf(2.7, 4.0).shortage(), "") << "the vehicle may stick out";
  EXPECT_EQ(spotOf(1.9, 5.5).shortage(), "") << "roughly drawn";
  const std::string tiny = spotOf(1.0, 2.0).shortage();
  EXPECT_NE(tiny.find("2.00 m long and 1.00 m wide"), std::string::npos) << tiny;
  EXPECT_NE(spotOf(1.7, 5.5).shortage().find("parking_position_tolerance"), std::string::npos);
}

}  // namespace
}  // namespace external_command
