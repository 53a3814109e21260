// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "external_command/LaneFollow.h"
#include "external_command/ros/motion_command_processor.h"

namespace external_command {

/// Drives along the lanes to a pose.
class LaneFollowCommandProcessor : public MotionCommandProcessor<LaneFollow> {
 public:
  LaneFollowCommandProcessor();
  ~LaneFollowCommandProcessor() override;

 private:
  void check(const LaneFollowCommand& command) const override;
  std::optional<RoutingTask> convert(const LaneFollowCommand& command) override;
};

}  // namespace external_command
