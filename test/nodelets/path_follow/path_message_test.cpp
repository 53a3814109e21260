// SPDX-License-Identifier: Apache-2.0
#include "nodelets/path_follow/path_message.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "external_command/core/error.h"
#include "support/refusal.h"

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

PathFollowCommand commandOf(const nav_msgs::Path& path) {
  return toPathFollowCommand(path, [](const std::string& frame) -> Pose2d {
    if (frame == "yard") return {100.0, 200.0, M_PI / 2.0};
    if (frame == "odom") return {10.0, 0.0, 0.0};
    if (frame == "map") return {};
    throw InvalidRequest("header.frame_id '" + frame + "' is not known");
  });
}

std::string messageRefusal(const nav_msgs::Path& path) {
  return refusalOf([&] { commandOf(path); });
}

TEST(PathMessage, KeepsHeaderAndPositions) {
  const PathFollowCommand command = commandOf(pathOf({{1.0, 2.0}, {3.0, 4.0}}));
  EXPECT_EQ(command.header.frame_id, "odom");
  ASSERT_EQ(command.way_point.size(), 2u);
  EXPECT_EQ(command.way_point[1].x, 3.0);
  EXPECT_EQ(command.way_point[1].y, 4.0);
  EXPECT_EQ(command.command_id, 0);
}

TEST(PathMessage, MakesHeadingsOfOrientations) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}});
  for (const std::size_t i : {0, 1, 2}) turn(&path, i, 0.75 + M_PI + 0.1 * i);
  const PathFollowCommand command = commandOf(path);
  ASSERT_EQ(command.heading.size(), 3u);
  EXPECT_NEAR(std::remainder(command.heading[2] - (0.95 + M_PI), 2.0 * M_PI), 0.0, 1e-9);
  EXPECT_FALSE(command.has_end_heading);
}

TEST(PathMessage, HasNoHeadingsWhereNobodyFilledThemIn) {
  for (const double w : {0.0, 1.0, -1.0}) {
    nav_msgs::Path path = pathOf({{5.0, 0.0}, {4.0, 0.0}, {3.0, 0.0}});
    for (geometry_msgs::PoseStamped& stamped : path.poses) stamped.pose.orientation.w = w;
    EXPECT_TRUE(commandOf(path).heading.empty()) << w;
    EXPECT_FALSE(commandOf(path).has_end_heading) << w;
  }
}

TEST(PathMessage, TakesTheLastOrientationAloneAsTheHeadingToEndWith) {
  for (const double w : {0.0, 1.0}) {
    nav_msgs::Path path = pathOf({{5.0, 5.0}, {5.0, 6.0}, {5.0, 7.0}});
    for (const std::size_t i : {0, 1}) path.poses[i].pose.orientation.w = w;
    turn(&path, 2, 1.5);
    const PathFollowCommand command = commandOf(path);
    EXPECT_TRUE(command.heading.empty());
    EXPECT_TRUE(command.has_end_heading);
    EXPECT_NEAR(command.end_heading, 1.5, 1e-9);
  }
}

TEST(PathMessage, ReversesWhereTheOrientationsSaySo) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {5.0, 1.0}, {2.0, 1.0}});
  turn(&path, 0, 0.1);
  for (const std::size_t i : {1, 2}) turn(&path, i, 0.0);
  ASSERT_EQ(commandOf(path).heading.size(), 3u);
  EXPECT_EQ(commandOf(path).heading[2], 0.0);
}

TEST(PathMessage, TakesQuaternionsOfAnyLength) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {1.0, 1.0}});
  for (const double length : {1e-200, 0.3, 7.0, 1e200}) {
    for (const std::size_t i : {0, 1}) {
      path.poses[i].pose.orientation.z = length * std::sin(0.4);
      path.poses[i].pose.orientation.w = length * std::cos(0.4);
    }
    EXPECT_NEAR(commandOf(path).heading[1], 0.8, 1e-9) << length;
  }
}

TEST(PathMessage, CountsEachPoseInItsOwnFrame) {
  nav_msgs::Path path = pathOf({{1.0, 0.0}, {2.0, 0.0}});
  for (geometry_msgs::PoseStamped& stamped : path.poses) stamped.header.frame_id = "yard";
  EXPECT_EQ(commandOf(path).header.frame_id, "yard") << "the poses', not the path's";
  EXPECT_EQ(commandOf(path).way_point[1].x, 2.0);

  path.poses[1].header.frame_id = "";  // the path's: odom
  turn(&path, 0, 0.5);
  turn(&path, 1, 0.5);
  const PathFollowCommand mixed = commandOf(path);
  EXPECT_EQ(mixed.header.frame_id, "") << "the map's";
  EXPECT_NEAR(mixed.way_point[0].x, 100.0, 1e-9);
  EXPECT_NEAR(mixed.way_point[0].y, 201.0, 1e-9);
  EXPECT_NEAR(mixed.way_point[1].x, 12.0, 1e-9);
  EXPECT_NEAR(mixed.heading[0], 0.5 + M_PI / 2.0, 1e-9);
  EXPECT_NEAR(mixed.heading[1], 0.5, 1e-9);
}

TEST(PathMessage, TakesAFrameWithASlashForTheSame) {
  nav_msgs::Path path = pathOf({{1.0, 0.0}, {2.0, 0.0}});
  path.header.frame_id = "/map";
  path.poses[1].header.frame_id = "map";
  EXPECT_EQ(commandOf(path).header.frame_id, "map");
}

TEST(PathMessage, RefusesWhatHasNoDirectionAndFramesThatAreNotKnown) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {5.0, 0.0}, {9.0, 0.0}});
  turn(&path, 0, 0.3);
  EXPECT_NE(messageRefusal(path).find("poses[1].pose.orientation is zero"), std::string::npos) << messageRefusal(path);
  turn(&path, 1, std::nan(""));
  EXPECT_NE(messageRefusal(path).find("poses[1].pose.orientation is not finite"), std::string::npos)
      << messageRefusal(path);
  path.poses[2].header.frame_id = "nowhere";
  turn(&path, 1, 0.3);
  EXPECT_NE(messageRefusal(path).find("poses[2].header.frame_id 'nowhere'"), std::string::npos) << messageRefusal(path);
}

TEST(PathMessage, NamesTheFieldThatHasTheUnknownFrame) {
  nav_msgs::Path path = pathOf({{0.0, 0.0}, {5.0, 0.0}});
  path.header.frame_id = "nowhere";
  EXPECT_EQ(messageRefusal(path), "header.frame_id 'nowhere' is not known");
  for (geometry_msgs::PoseStamped& stamped : path.poses) stamped.header.frame_id = "elsewhere";
  EXPECT_EQ(messageRefusal(path), "poses[0].header.frame_id 'elsewhere' is not known");
}

TEST(PathMessage, RefusesPositionsThatAreNone) {
  EXPECT_EQ(messageRefusal(pathOf({{0.0, 0.0}, {1e6, -1e6}})), "");
  EXPECT_EQ(messageRefusal(pathOf({{0.0, 0.0}, {5.0, std::nan("")}})),
            "poses[1].pose.position.y is nan; it must be finite");
  EXPECT_NE(messageRefusal(pathOf({{0.0, 0.0}, {1e300, 0.0}})).find("poses[1].pose.position.x is 1e+300"),
            std::string::npos);
}

TEST(PathMessage, LeavesTheRefusalOfShortPathsToTheCheck) {
  EXPECT_TRUE(commandOf(pathOf({})).way_point.empty());
  EXPECT_EQ(commandOf(pathOf({{1.0, 2.0}})).way_point.size(), 1u);
}

}  // namespace
}  // namespace external_command
