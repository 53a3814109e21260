// SPDX-License-Identifier: Apache-2.0
// Stamps of messages that are compared with each other.
#include "external_command/ros/rising_stamps.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

class Stamps : public testing::Test {
 protected:
  void SetUp() override {
    ros::Time::init();
    ros::Time::setNow(ros::Time(100.0));
  }
  void TearDown() override { ros::Time::init(); }  // back to the time of the system

  RisingStamps stamps_;
};

TEST_F(Stamps, AreThePresentTime) {
  EXPECT_EQ(stamps_.next(), ros::Time(100.0));
  ros::Time::setNow(ros::Time(101.0));
  EXPECT_EQ(stamps_.next(), ros::Time(101.0));
}

TEST_F(Stamps, RiseWhileTimeStandsStill) {
  const ros::Time first = stamps_.next(), second = stamps_.next();
  EXPECT_LT(first, second);
  EXPECT_LT(second, stamps_.next());
  EXPECT_LT(second - first, ros::Duration(1e-6));
}

TEST_F(Stamps, RiseWhereAClockIsPutRightByALittle) {
  const ros::Time first = stamps_.next();
  ros::Time::setNow(ros::Time(99.99));
  EXPECT_LT(first, stamps_.next());
}

TEST_F(Stamps, FollowAClockThatIsSetBack) {
  stamps_.next();
  ros::Time::setNow(ros::Time(5.0));
  EXPECT_EQ(stamps_.next(), ros::Time(5.0));
}

}  // namespace
}  // namespace external_command
