// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/drive_limits.h"

#include <gtest/gtest.h>

#include "external_command/core/error.h"
#include "support/refusal.h"

namespace external_command {
namespace {

///   (0, 60) +--------------+ (100, 60)
///           |              |
///           |              |   a spike of 10 cm at x = 50, from the upper border down to y = 32
///           |              |
///    (0, 0) +--------------+ (100, 0)
DriveLimits yard(bool has_spike = false) {
  std::vector<Point2d> points = {{0.0, 0.0}, {100.0, 0.0}, {100.0, 60.0}};
  if (has_spike) points.insert(points.end(), {{50.05, 60.0}, {50.0, 32.0}, {49.95, 60.0}});
  points.emplace_back(0.0, 60.0);
  DriveLimits limits;
  limits.geofence.emplace(points, "limits/geofence");
  return limits;
}

Path straight(double y, double from_x, double to_x) {
  Path path;
  for (double x = from_x; x <= to_x; x += 0.5) {
    ReferencePoint point;
    point.x = x;
    point.y = y;
    path.push_back(point);
  }
  setArcLengths(&path);
  return path;
}

std::string pathRefusal(const DriveLimits& limits, const Path& path) {
  return refusalOf([&] { limits.requireInside(path, VehicleParams()); });
}

TEST(DriveLimits, TakeEverythingWhereNoneIsSet) {
  const DriveLimits limits;
  EXPECT_NO_THROW(limits.validate());
  EXPECT_NO_THROW(limits.requireSpeed(100.0));
  EXPECT_NO_THROW(limits.requireGoal({0.0, 0.0}, {1e6, 0.0}));
  EXPECT_EQ(pathRefusal(limits, straight(0.0, 0.0, 1000.0)), "");
}

TEST(DriveLimits, TakeAPathThatKeepsTheWholeVehicleInside) {
  EXPECT_EQ(pathRefusal(yard(), straight(30.0, 1.0, 96.0)), "");
  EXPECT_EQ(pathRefusal(yard(), straight(1.1, 1.0, 96.0)), "") << "the vehicle is 2 m wide";
}

TEST(DriveLimits, RefuseAPathOfWhichACornerOfTheVehicleLeavesTheFence) {
  EXPECT_NE(pathRefusal(yard(), straight(0.9, 1.0, 96.0)), "");
  EXPECT_NE(pathRefusal(yard(), straight(30.0, 0.5, 96.0)), "") << "the rear overhangs";
  EXPECT_EQ(pathRefusal(yard(), straight(30.0, 1.0, 120.0)),
            "the path leaves the geofence at (96.50, 30.00), 95.50 m from its beginning (~limits/geofence)");
}

TEST(DriveLimits, RefuseAPathWhoseVehicleCoversASpikeOfTheFence) {
  EXPECT_EQ(pathRefusal(yard(true), straight(30.0, 1.0, 96.0)), "");
  EXPECT_NE(pathRefusal(yard(true), straight(31.5, 1.0, 96.0)), "") << "no corner of the footprint is outside";
  EXPECT_NE(pathRefusal(yard(true), straight(40.0, 1.0, 96.0)), "") << "nor is the tip of the spike inside it";
}

TEST(DriveLimits, RefuseAGoalTooFarAway) {
  DriveLimits limits;
  limits.max_goal_distance = 100.0;
  EXPECT_NO_THROW(limits.requireGoal({0.0, 0.0}, {100.0, 0.0}));
  EXPECT_THROW(limits.requireGoal({0.0, 0.0}, {100.1, 0.0}), InvalidRequest);
}

TEST(DriveLimits, RefuseASpeedTooHigh) {
  DriveLimits limits;
  limits.max_speed = 5.0;
  EXPECT_NO_THROW(limits.requireSpeed(0.0)) << "not given";
  EXPECT_NO_THROW(limits.requireSpeed(5.0));
  EXPECT_THROW(limits.requireSpeed(5.1), InvalidRequest);
}

TEST(DriveLimits, RefuseALimitThatNoVehicleDrivesAt) {
  DriveLimits limits;
  limits.max_speed = 0.01;
  EXPECT_NO_THROW(limits.validate());
  limits.max_speed = 0.009;
  EXPECT_THROW(limits.validate(), InvalidParameter);
}

TEST(DriveLimits, RefuseParametersBelowZero) {
  DriveLimits limits;
  limits.max_speed = -1.0;
  EXPECT_THROW(limits.validate(), InvalidParameter);
}

TEST(DriveLimits, LookAtNoMoreOfThePathOnceItIsCancelled) {
  const CancelSource cancel;
  cancel.cancel();
  EXPECT_THROW(yard().requireInside(straight(30.0, 1.0, 96.0), VehicleParams(), cancel.token()), Cancelled);
}

}  // namespace
}  // namespace external_command
