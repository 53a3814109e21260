// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace external_command {
namespace {

/// `count` poses `step` [m] apart on a circle of curvature `kappa` [1/m], from `start` on, in one gear, at 10 m/s.
Path arc(const Pose2d& start, double kappa, double step, int count, Direction direction = Direction::kForward) {
  const double signed_step = direction == Direction::kForward ? step : -step;
  Path path;
  for (int i = 0; i < count; ++i) {
    const double s = i * signed_step;
    const double turn = kappa * s;
    const Pose2d local = std::abs(kappa) < 1e-12 ? Pose2d{s, 0.0, 0.0}
                                                 : Pose2d{std::sin(turn) / kappa, (1.0 - std::cos(turn)) / kappa, turn};
    const Pose2d pose = compose(start, local);
    path.emplace_back();
    path.back().x = pose.x;
    path.back().y = pose.y;
    path.back().heading = pose.heading;
    path.back().speed = 10.0;
    path.back().direction = direction;
  }
  setArcLengths(&path);
  return path;
}

/// 10 m ahead, then 5 m back to the left.
Path aheadAndBack() {
  const Path ahead = arc({0, 0, 0}, 0.0, 0.5, 21);
  return join(ahead, arc(ahead.back().pose(), 0.1, 0.5, 11, Direction::kReverse));
}

TEST(Path, IsSlowWhereTheCurvatureStepsBetweenItsParts) {
  VehicleParams vehicle;
  Path ahead = arc({0, 0, 0}, 0.0, 0.5, 21), turn = arc(ahead.back().pose(), 0.15, 0.1, 51);
  setCurvatures(&ahead);
  setCurvatures(&turn);
  Path path = join(ahead, turn, vehicle);
  limitSpeeds(vehicle, &path);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double mean = 0.5 * (path[i - 1].speed + path[i].speed), time = (path[i].s - path[i - 1].s) / mean;
    const double turned =
        std::atan(vehicle.wheelbase * path[i].kappa) - std::atan(vehicle.wheelbase * path[i - 1].kappa);
    EXPECT_LE(std::abs(turned) / time, 1.01 * vehicle.max_steering_rate) << i;
  }
}

TEST(Path, IsAsFastAsItsPartsWhereTheCurvatureGoesOn) {
  Path ahead = arc({0, 0, 0}, 0.0, 0.5, 21), further = arc(ahead.back().pose(), 0.0, 0.5, 21);
  for (const ReferencePoint& point : join(ahead, further, VehicleParams())) EXPECT_EQ(point.speed, 10.0);
}

TEST(Path, StopsAnywayWhereTheGearChangesBetweenItsParts) {
  const Path ahead = arc({0, 0, 0}, 0.0, 0.5, 21);
  Path back = arc(ahead.back().pose(), 0.15, 0.5, 11, Direction::kReverse);
  setCurvatures(&back);
  const Path path = join(ahead, back, VehicleParams());
  ASSERT_GT(path[21].kappa, 0.1);
  for (const ReferencePoint& point : path) EXPECT_EQ(point.speed, 10.0) << "the wheels turn while the vehicle stands";
}

TEST(Path, MeasuresArcsAlongTheCircle) {
  const Path path = arc({3, 4, 1}, 0.2, 1.0, 11);
  EXPECT_NEAR(path.back().s, 10.0, 1e-9);
  EXPECT_EQ(path.front().s, 0.0);
}

TEST(Path, HasTheCurvatureOfTheTurnInEitherGear) {
  for (const double kappa : {0.0, 0.2, -0.15}) {
    for (const Direction direction : {Direction::kForward, Direction::kReverse}) {
      Path path = arc({3, 4, 1}, kappa, 0.5, 21, direction);
      setCurvatures(&path);
      for (const auto& point : path) EXPECT_NEAR(point.kappa, kappa, 1e-9);
    }
  }
}

TEST(Path, DoesNotBendOneLegByTheNext) {
  Path path = aheadAndBack();
  setCurvatures(&path);
  for (std::size_t i = 0; i <= 20; ++i) EXPECT_NEAR(path[i].kappa, 0.0, 1e-9) << i;
  for (std::size_t i = 21; i < path.size(); ++i) EXPECT_NEAR(path[i].kappa, 0.1, 1e-9) << i;
}

TEST(Path, HasNoCurvatureWhereItHasNoLength) {
  Path none, one = arc({}, 0.0, 1.0, 1), same = arc({}, 0.0, 0.0, 3);
  for (Path* path : {&none, &one, &same}) {
    setArcLengths(path);
    setCurvatures(path);
    for (const auto& point : *path) EXPECT_EQ(point.kappa, 0.0);
  }
}

TEST(Path, JoinsWithoutRepeatingTheJoint) {
  const Path path = aheadAndBack();
  EXPECT_EQ(path.size(), 31u);
  EXPECT_NEAR(path.back().s, 15.0, 1e-9);
  for (std::size_t i = 1; i < path.size(); ++i) EXPECT_GT(path[i].s, path[i - 1].s);
}

TEST(Path, KeepsTheCapsOfBothPiecesAtAJoint) {
  Path first = arc({0, 0, 0}, 0.0, 0.5, 21);
  for (ReferencePoint& point : first) point.speed = 3.0;
  const Path joined = join(first, arc(first.back().pose(), 0.1, 0.5, 11, Direction::kReverse));
  EXPECT_EQ(joined[20].speed, 3.0);
  EXPECT_EQ(joined[21].speed, 10.0);
}

TEST(Path, IsInTheSecondGearWhereTheFirstPieceIsASinglePoint) {
  const Path path = join(arc({}, 0.0, 1.0, 1), arc({}, 0.1, 0.5, 5, Direction::kReverse));
  EXPECT_EQ(path.front().direction, Direction::kReverse);
  EXPECT_EQ(gearChanges(path), 0u);
}

TEST(Path, JoinsWithNothing) {
  const Path path = arc({}, 0.1, 1.0, 5);
  EXPECT_EQ(join(path, {}).size(), 5u);
  EXPECT_EQ(join({}, path).size(), 5u);
  EXPECT_TRUE(join({}, {}).empty());
}

TEST(Path, CountsReverseDrivingAndGearChanges) {
  EXPECT_NEAR(reverseLength(aheadAndBack()), 5.0, 1e-9);
  EXPECT_EQ(gearChanges(aheadAndBack()), 1u);
  EXPECT_EQ(reverseLength({}), 0.0);
  EXPECT_EQ(gearChanges({}), 0u);
  EXPECT_EQ(gearChanges(arc({}, 0.0, 1.0, 9, Direction::kReverse)), 0u);
}

TEST(SpeedLimits, StopAtTheEndAndWhereTheGearChanges) {
  Path path = aheadAndBack();
  path[20].speed = 10.0;
  limitSpeeds({}, &path);
  EXPECT_EQ(path[20].speed, 0.0);
  EXPECT_EQ(path.back().speed, 0.0);
}

/// Of the change of speed on the way to each point, the first left out [m/s^2].
std::vector<double> accelerations(const Path& path) {
  std::vector<double> values;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double before = path[i - 1].speed, after = path[i].speed;
    values.push_back((after * after - before * before) / (2.0 * (path[i].s - path[i - 1].s)));
  }
  return values;
}

TEST(SpeedLimits, CanBeBrakedForAndSpedUpToEverywhere) {
  const VehicleParams vehicle;
  const Path first = arc({}, 0.0, 0.5, 201);
  Path slow = arc(first.back().pose(), 0.0, 0.1, 101);
  for (ReferencePoint& point : slow) point.speed = 1.0;
  Path path = join(join(first, slow), arc(slow.back().pose(), 0.0, 0.5, 201));
  limitSpeeds(vehicle, &path);
  for (const double acceleration : accelerations(path)) {
    EXPECT_GE(acceleration, -vehicle.max_deceleration - 1e-9);
    EXPECT_LE(acceleration, vehicle.max_acceleration + 1e-9);
  }
  EXPECT_EQ(path.front().speed, 10.0);
  EXPECT_EQ(path[201].speed, 1.0);
  EXPECT_EQ(path[430].speed, 10.0) << "as fast as the cap after the slow piece";
}

TEST(SpeedLimits, AreAbove0OutsideOfTheStops) {
  Path path = aheadAndBack();
  for (ReferencePoint& point : path) point.speed = std::numeric_limits<double>::infinity();
  limitSpeeds({}, &path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool stops = i == 20 || i == 30;
    EXPECT_EQ(path[i].speed == 0.0, stops) << i;
    EXPECT_TRUE(std::isfinite(path[i].speed));
  }
}

TEST(SpeedLimits, AreAbove0WhateverTheCap) {
  Path path = aheadAndBack();
  for (ReferencePoint& point : path) point.speed = 1e-200;
  limitSpeeds({}, &path);
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_EQ(path[i].speed == 0.0, i == 20 || i == 30) << i;
}

TEST(SpeedLimits, KeepToBendsGearsAndWhatWasThereBefore) {
  VehicleParams vehicle;
  vehicle.max_lateral_acceleration = 2.0;
  Path bend = arc({}, 0.125, 0.5, 101);
  setCurvatures(&bend);
  limitSpeeds(vehicle, &bend);
  EXPECT_NEAR(bend.front().speed, 4.0, 1e-6);
  Path back = arc({}, 0.0, 0.5, 101, Direction::kReverse);
  limitSpeeds(vehicle, &back);
  EXPECT_EQ(back[10].speed, vehicle.max_reverse_speed);
  Path slow = arc({}, 0.0, 0.5, 101);
  for (auto& point : slow) point.speed = 1.5;
  limitSpeeds(vehicle, &slow);
  EXPECT_EQ(slow[10].speed, 1.5);
}

TEST(SpeedLimits, TakeAnyPath) {
  Path none, one = arc({}, 0.0, 1.0, 1);
  limitSpeeds({}, &none);
  limitSpeeds({}, &one);
  EXPECT_EQ(one.front().speed, 0.0);
}

}  // namespace
}  // namespace external_command
