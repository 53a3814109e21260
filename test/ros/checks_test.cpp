// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/checks.h"

#include <gtest/gtest.h>

#include <limits>

#include "external_command/core/error.h"
#include "support/refusal.h"

namespace external_command {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Pose poseAt(double x, double y) {
  Pose pose;
  pose.x = x;
  pose.y = y;
  return pose;
}

TEST(Checks, TakeCoordinatesOfAnyMap) {
  EXPECT_NO_THROW(requireFinite(poseAt(0.0, 0.0), "end_pose"));
  EXPECT_NO_THROW(requireFinite(poseAt(833978.0, -9999999.0), "end_pose"));
}

TEST(Checks, RefuseCoordinatesOfNoMapAndNameTheField) {
  for (const double value : {kNan, kInfinity, -kInfinity, 1e308, -1e10}) {
    try {
      requireFinite(poseAt(0.0, value), "end_pose");
      FAIL() << value << " was taken";
    } catch (const InvalidRequest& error) {
      EXPECT_NE(std::string(error.what()).find("end_pose.y"), std::string::npos) << error.what();
    }
  }
}

TEST(Checks, LeaveNumbersThatNobodyReads) {
  Pose pose = poseAt(1.0, 2.0);
  pose.heading = kNan;
  pose.z = kInfinity;
  EXPECT_NO_THROW(requireFinite(pose, "end_pose"));
  EXPECT_NO_THROW(requireSendable(poseAt(1.0, 2.0), "parking_spot_pose"));
  RoiPolygon polygon;
  polygon.points.resize(3);
  polygon.points[2].z = kNan;
  EXPECT_NO_THROW(checkPolygon(polygon, "drivable_roi", {}));
}

TEST(Checks, RefuseNumbersThatGoOnWithTheCommandThoughNobodyUsesThem) {
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    Pose turned = poseAt(1.0, 2.0), raised = poseAt(1.0, 2.0);
    turned.heading = value;
    raised.z = value;
    EXPECT_NE(refusalOf([&] { requireSendable(turned, "parking_spot_pose"); }).find("parking_spot_pose.heading is "),
              std::string::npos);
    EXPECT_NE(refusalOf([&] {
                requireSendable({poseAt(0.0, 0.0), raised}, "way_point");
              }).find("way_point[1].z is "),
              std::string::npos);
    std::vector<geometry_msgs::Point> points(3);
    points[2].z = value;
    EXPECT_NE(refusalOf([&] { checkPoints(points, 2, "left_boundary"); }).find("left_boundary[2].z is "),
              std::string::npos);
  }
  EXPECT_NO_THROW(checkPoints(std::vector<geometry_msgs::Point>(3), 2, "left_boundary"));
}

TEST(Checks, TakeATargetSpeedThatAVehicleDrivesAtOrThatIsNotGiven) {
  for (const double speed : {0.0, 0.01, 1.0, 1e300}) EXPECT_NO_THROW(requireTargetSpeed(speed)) << speed;
}

TEST(Checks, RefuseATargetSpeedThatNoVehicleDrivesAt) {
  for (const double speed : {1e-320, 1e-160, 0.0099, -1.0, kNan, kInfinity}) {
    try {
      requireTargetSpeed(speed);
      FAIL() << speed << " was taken";
    } catch (const InvalidRequest& error) {
      EXPECT_NE(std::string(error.what()).find("target_speed is "), std::string::npos) << error.what();
    }
  }
}

TEST(Checks, TakeARequestWithoutAStampOrWithARecentOne) {
  ros::Time::init();
  EXPECT_NO_THROW(requireFresh(ros::Time(), 2.0));
  EXPECT_NO_THROW(requireFresh(ros::Time::now(), 2.0));
}

TEST(Checks, RefuseStampsHoweverFarFromNow) {
  ros::Time::init();
  const ros::Time last_of_all(std::numeric_limits<std::uint32_t>::max(), 0);
  for (const ros::Time& stamp : {ros::Time(1), ros::Time::now() - ros::Duration(3.0), last_of_all}) {
    EXPECT_THROW(requireFresh(stamp, 2.0), StaleRequest) << stamp;
  }
}

}  // namespace
}  // namespace external_command
