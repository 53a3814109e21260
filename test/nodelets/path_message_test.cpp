// SPDX-License-Identifier: Apache-2.0
#include "nodelets/path_message.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace external_command {
namespace {

nav_msgs::Path pathOf(const std::vector<std::pair<double, double>>& points) {
  nav_msgs::Path path;
  path.header.frame_id = "odom";
  for (const auto& [x, y] : points) {
    path.poses.emplace_back();
    path.poses.back().pose.position.x = x;
    path.poses.back().pose.position.y = y;
  }
  return path;
}

void turn(nav_msgs::Path* path, std::size_t i, double heading) {
  path->poses[i].pose.orientation.z = std::sin(heading / 2.0);
  path->poses[i].pose.orientation.w = std::cos(heading / 2.0);
}

TEST(PathMessage, KeepsHeaderAndPositions) {
  const PathFollowCommand command = toPathFollowCommand(pathOf({{1.0, 2.0}, {3.0, 4.0}}));
  EXPECT_EQ(command.header.frame_id, "odom");
  ASSERT_EQ(command.way_point.size(), 2u);
  EXPECT_EQ(command.way_point[1].x, 3.0);
  EXPECT_EQ(command.way_point[1].y, 4.0);
  EXPECT_EQ(command.command_id, 0);
}

TEST(PathMessage, MakesHeadingsOfOrientations) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}});
  for (const std::size_t i : {0, 1, 2}) turn(&path, i, 0.75 + M_PI + 0.1 * i);
  const PathFollowCommand command = toPathFollowCommand(path);
  ASSERT_EQ(command.heading.size(), 3u);
  EXPECT_NEAR(std::remainder(command.heading[2] - (0.95 + M_PI), 2.0 * M_PI), 0.0, 1e-9);
}

TEST(PathMessage, HasNoHeadingsWhereNobodyFilledThemIn) {
  EXPECT_TRUE(toPathFollowCommand(pathOf({{0.0, 0.0}, {1.0, 0.0}})).heading.empty()) << "all zero";
  nav_msgs::Path identity = pathOf({{0.0, 0.0}, {1.0, 0.0}, {1.0, 5.0}});
  for (const std::size_t i : {0, 1, 2}) turn(&identity, i, 0.0);
  EXPECT_TRUE(toPathFollowCommand(identity).heading.empty()) << "the path goes across heading 0";
}

TEST(PathMessage, TakesTheIdentityAsHeadingAlongX) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {5.0, 0.0}, {2.0, 0.0}});
  for (const std::size_t i : {0, 1, 2}) turn(&path, i, 0.0);
  EXPECT_EQ(toPathFollowCommand(path).heading, std::vector<double>(3, 0.0));
}

TEST(PathMessage, MarksASingleOrientationWithoutDirection) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {5.0, 0.0}});
  turn(&path, 0, 0.3);
  EXPECT_TRUE(std::isnan(toPathFollowCommand(path).heading[1]));
}

}  // namespace
}  // namespace external_command
