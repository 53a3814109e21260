// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Path.h>

#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "external_command/PathFollow.h"
#include "external_command/core/waypoint_path.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/motion_command_processor.h"
#include "nodelets/distance_limits.h"

namespace external_command {

/// Follows a given path. Needs no map.
class PathFollowCommandProcessor : public MotionCommandProcessor<PathFollow> {
 public:
  PathFollowCommandProcessor();
  ~PathFollowCommandProcessor() override;

 private:
  void start() override;
  void open() override;
  void check(const PathFollowCommand& command) const override;
  bool beginsAtVehicle(const PathFollowCommand& /*command*/) const override { return false; }
  void processSpecialCommand(const PathFollowCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  void takePath(const ros::MessageEvent<nav_msgs::Path const>& event);
  Response carryOutOfMessage(const PathFollowCommand& command, const std::string& caller);

  /// What who sent this command calls its points: while it is planned.
  WaypointNames namesOf(std::int64_t command_id) const;

  /// @param names  of the fields that whoever sent it has filled in. @throws InvalidRequest
  void checkLine(const PathFollowCommand& command, const WaypointNames& names) const;

  void checkStart(const Point2d& start, std::vector<std::string>* warnings) const;

  DistanceLimits start_limits_{5.0, 0.0};
  LogThrottle path_warnings_{0.05};
  mutable std::mutex mutex_;
  std::set<std::int64_t> of_messages_;  ///< ids of the commands in work that came as nav_msgs/Path
  ros::Subscriber path_subscriber_;
};

}  // namespace external_command
