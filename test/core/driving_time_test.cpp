// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/driving_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace external_command {
namespace {

VehicleParams vehicle() {
  VehicleParams params;
  params.max_speed = 10.0;
  params.max_reverse_speed = 2.0;
  params.max_acceleration = 1.0;
  params.max_deceleration = 2.0;
  return params;
}

/// Straight legs of these lengths [m], each in the other gear than the one before, with limits of the speed.
std::shared_ptr<const Path> legs(const std::vector<double>& lengths, double spacing = 0.1) {
  Path path(1);
  double gear = 1.0;
  for (const double length : lengths) {
    const ReferencePoint begin = path.back();
    const int points = static_cast<int>(std::lround(length / spacing));
    for (int i = 1; i <= points; ++i) {
      ReferencePoint point = begin;
      point.x += gear * i * length / points;
      point.direction = gear > 0.0 ? Direction::kForward : Direction::kReverse;
      point.speed = std::numeric_limits<double>::infinity();
      path.push_back(point);
    }
    gear = -gear;
  }
  setArcLengths(&path);
  limitSpeeds(vehicle(), &path);
  return std::make_shared<const Path>(path);
}

TEST(DrivingTime, SpeedsUpDrivesAndBrakes) {
  // 50 m to 10 m/s in 10 s, 25 m from there to a stop in 5 s, 125 m between in 12.5 s.
  const DrivingTime time(vehicle(), legs({200.0}));
  EXPECT_NEAR(time.left(0.0, 0.0), 27.5, 0.1);
  EXPECT_NEAR(time.left(100.0, 10.0), 12.5, 0.1);
  EXPECT_NEAR(time.left(175.0, 10.0), 5.0, 0.1);
  EXPECT_NEAR(time.left(200.0, 0.0), 0.0, 0.01);
}

TEST(DrivingTime, TakesLongerWhereAnOrderIsSlower) {
  // To 5 m/s in 12.5 m and 5 s, from there to a stop in 6.25 m and 2.5 s, 181.25 m between in 36.25 s.
  EXPECT_NEAR(DrivingTime(vehicle(), legs({200.0}), {5.0, 1.0}).left(0.0, 0.0), 43.75, 0.3);
  const double half = DrivingTime(vehicle(), legs({200.0}), {1000.0, 0.5}).left(100.0, 5.0);
  EXPECT_NEAR(half, 2.0 * DrivingTime(vehicle(), legs({200.0})).left(100.0, 10.0), 0.3);
}

TEST(DrivingTime, CountsWithTheSlowestSpeedWhereAFactorAsksForLess) {
  for (const double factor : {1e-3, 1e-9, 1e-300, std::numeric_limits<double>::denorm_min()}) {
    const DrivingTime time(vehicle(), legs({200.0, 50.0}), {std::numeric_limits<double>::infinity(), factor});
    EXPECT_NEAR(time.left(0.0, 0.0), 250.0 / kLeastSpeed, 50.0) << factor;
  }
  const DrivingTime slow(vehicle(), legs({200.0}), {0.02, 0.1});
  EXPECT_NEAR(slow.left(0.0, 0.0), 200.0 / kLeastSpeed, 50.0);
  const DrivingTime faster(vehicle(), legs({200.0}), {std::numeric_limits<double>::infinity(), 0.0011});
  EXPECT_LT(faster.left(0.0, 0.0), 0.95 * 200.0 / kLeastSpeed);
}

TEST(DrivingTime, IsTheSameWhereAnOrderIsFasterThanThePath) {
  EXPECT_DOUBLE_EQ(DrivingTime(vehicle(), legs({200.0}), {50.0, 1.0}).left(0.0, 0.0),
                   DrivingTime(vehicle(), legs({200.0})).left(0.0, 0.0));
}

TEST(DrivingTime, TakesLongerFromStanding) {
  const DrivingTime time(vehicle(), legs({200.0}));
  EXPECT_NEAR(time.left(100.0, 0.0), 10.0 + 2.5 + 5.0, 0.1);
}

TEST(DrivingTime, StopsWhereTheGearChanges) {
  // 12 m forward: 4 m/s after 8 m and 4 s, at rest 2 s later. 12 m back at 2 m/s: 2 m in 2 s, 9 m in 4.5 s, 1 m in 1 s.
  const DrivingTime time(vehicle(), legs({12.0, 12.0}));
  EXPECT_NEAR(time.left(0.0, 0.0), 6.0 + 7.5, 0.2);
  EXPECT_NEAR(time.left(12.0, 0.0), 7.5, 0.2);
}

TEST(DrivingTime, NeverGrowsAlongThePathAtItsSpeeds) {
  const auto path = legs({30.0, 5.0, 40.0});
  const DrivingTime time(vehicle(), path);
  double last = time.left(0.0, 0.0);
  for (const ReferencePoint& point : *path) {
    const double left = time.left(point.s, point.speed);
    EXPECT_LE(left, last + 1e-6) << point.s;
    last = left;
  }
  EXPECT_NEAR(last, 0.0, 1e-9);
}

TEST(DrivingTime, IsFiniteForPathsOfStopsOnly) {
  const DrivingTime two_points(vehicle(), legs({3.0}, 3.0));
  EXPECT_NEAR(two_points.left(0.0, 0.0), 2.0 + 1.0, 0.01) << "2 m/s after 2 m and 2 s, at rest 1 s later";
  const DrivingTime nowhere(vehicle(), std::make_shared<const Path>(Path(2)));
  EXPECT_EQ(nowhere.left(0.0, 0.0), 0.0);
}

TEST(DrivingTime, HoldsForAVehicleThatIsFasterThanThePathAllows) {
  const DrivingTime time(vehicle(), legs({200.0}));
  const double left = time.left(199.0, 12.0);
  EXPECT_GT(left, 0.0);
  EXPECT_LT(left, 1.0);
}

}  // namespace
}  // namespace external_command
