// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/publisher.h>

#include <memory>
#include <optional>
#include <vector>

#include "external_command/PlanningCommand.h"
#include "external_command/RoutingResponse.h"
#include "external_command/core/path.h"
#include "external_command/ros/prepared_message.h"

namespace external_command {

/// Where motion commands are published, latched but for the history: who subscribes later gets the newest.
struct MotionPublishers {
  std::vector<ros::Publisher> commands;
  ros::Publisher history, routing, path;
};

/// What the topics hold of one motion command for those who subscribe later. Not thread-safe, but for what is const:
/// the gate guards it.
class MotionTopics {
 public:
  /// @param command  as it was sent; its path may be left out.
  /// @param path     what is left for view() to show as path; nullptr where it was sent already.
  MotionTopics(MotionPublishers publishers, PlanningCommand&& command, std::shared_ptr<const Path> path);

  /// Takes the place of `earlier`, which is withdrawn where this one has nothing to put in its place: on the topics of
  /// other processors, and as route. To be called before view().
  void replace(const MotionTopics& earlier);

  /// What follows a command that was sent: its route, and its path for ordinary ROS controllers and rviz.
  std::vector<PreparedMessage> view() const;

  /// Replaces command, path and route by ones that nobody drives. Does so once.
  void withdraw();

  /// Puts the route back, and `rest` as path, where they were withdrawn.
  void showAgain(const Path& rest);

 private:
  PlanningCommand withdrawal() const;

  const MotionPublishers publishers_;
  const std::int64_t command_id_;
  const std_msgs::Header header_;
  const std::shared_ptr<const Path> path_;
  const std::optional<RoutingResponse> route_;
  bool is_withdrawn_ = false;
  bool ends_route_ = false;  ///< of an earlier motion, by an empty one
};

}  // namespace external_command
