// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/motion_bytes.h"

#include <gtest/gtest.h>
#include <nav_msgs/Path.h>

#include <cmath>
#include <string>

#include "external_command/ros/conversions.h"

namespace external_command {
namespace {

std::string contentOf(const ros::SerializedMessage& bytes) {
  return {reinterpret_cast<const char*>(bytes.buf.get()), bytes.num_bytes};
}

/// Forward, then back, with other numbers in each field of each point.
Path thereAndBack() {
  Path path(5);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double n = static_cast<double>(i + 1);
    path[i] = {0.1 * n, -0.2 * n, 0.3 * n, -0.01 * n, 0.5 * n, 3.0 / n};
    path[i].direction = i < 3 ? Direction::kForward : Direction::kReverse;
  }
  return path;
}

std_msgs::Header headerOf(const std::string& frame) {
  std_msgs::Header header;
  header.seq = 3;
  header.stamp = ros::Time(12, 34);
  header.frame_id = frame;
  return header;
}

PlanningCommand command() {
  PlanningCommand command;
  command.header = headerOf("map");
  command.command_id = 7;
  command.is_motion_command = true;
  command.target_speed = 2.5;
  command.has_lane_follow_command = true;
  command.lane_follow_command.map_version = "a town";
  command.custom_command.type = "a/Type";
  command.custom_command.data = {1, 2, 3};
  command.path.header = command.header;
  return command;
}

/// What roscpp makes of the command when its path is put into it.
std::string contentWith(const Path& path) {
  PlanningCommand whole = command();
  whole.path = toMsg(path);
  whole.path.header = whole.header;
  return contentOf(ros::serialization::serializeMessage(whole));
}

TEST(MotionBytes, AreThoseOfACommandWithThePathInIt) {
  const Path path = thereAndBack();
  EXPECT_EQ(contentOf(bytesOf(command(), path).message), contentWith(path));
}

TEST(MotionBytes, TellWhereTheToolWorks) {
  Path path = thereAndBack();
  path[2].tool_on = true;
  EXPECT_EQ(contentOf(bytesOf(command(), path).message), contentWith(path));
  EXPECT_NE(contentWith(path), contentWith(thereAndBack()));
}

TEST(MotionBytes, AreThoseOfACommandWithoutAPath) {
  EXPECT_EQ(contentOf(bytesOf(command(), {}).message), contentWith({}));
}

TEST(MotionBytes, MakeAPathForOrdinaryControllers) {
  const Path path = thereAndBack();
  nav_msgs::Path msg;
  ros::serialization::deserializeMessage(navPathBytesOf(path, headerOf("a_frame")).message, msg);
  const auto contentOfHeader = [](const std_msgs::Header& header) {
    return contentOf(ros::serialization::serializeMessage(header));
  };
  EXPECT_EQ(contentOfHeader(msg.header), contentOfHeader(headerOf("a_frame")));
  ASSERT_EQ(msg.poses.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto& pose = msg.poses[i].pose;
    EXPECT_EQ(contentOfHeader(msg.poses[i].header), contentOfHeader(headerOf("a_frame")));
    EXPECT_EQ(pose.position.x, path[i].x);
    EXPECT_EQ(pose.position.y, path[i].y);
    EXPECT_EQ(pose.position.z, 0.0);
    EXPECT_NEAR(2.0 * std::atan2(pose.orientation.z, pose.orientation.w), path[i].heading, 1e-12);
    EXPECT_EQ(pose.orientation.x, 0.0);
    EXPECT_EQ(pose.orientation.y, 0.0);
  }
}

TEST(MotionBytes, MakeAnEmptyPathForOrdinaryControllers) {
  nav_msgs::Path expected;
  expected.header = headerOf("map");
  EXPECT_EQ(contentOf(navPathBytesOf({}, headerOf("map")).message),
            contentOf(ros::serialization::serializeMessage(expected)));
}

}  // namespace
}  // namespace external_command
