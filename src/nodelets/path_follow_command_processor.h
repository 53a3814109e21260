// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Path.h>

#include <string>

#include "external_command/PathFollow.h"
#include "external_command/ros/motion_command_processor.h"

namespace external_command {

/// Follows a given path. Needs no map.
class PathFollowCommandProcessor : public MotionCommandProcessor<PathFollow> {
 public:
  PathFollowCommandProcessor();
  ~PathFollowCommandProcessor() override;

 private:
  void open() override;
  void check(const PathFollowCommand& command) const override;
  void processSpecialCommand(const PathFollowCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  ros::Subscriber path_subscriber_;
};

}  // namespace external_command
