// SPDX-License-Identifier: Apache-2.0
#include "lane_follow_command_processor.h"

namespace external_command {

LaneFollowCommandProcessor::LaneFollowCommandProcessor()
    : MotionCommandProcessor<LaneFollow>("external_command/lane_follow") {}

LaneFollowCommandProcessor::~LaneFollowCommandProcessor() { stopServing(); }

void LaneFollowCommandProcessor::check(const LaneFollowCommand& command) const {
  checkWayPoints(command.way_point, command.is_start_pose_set);
  requireFinite(command.end_pose, "end_pose");
  checkBlackList(command.blacklisted_lane, command.blacklisted_road);
  requireNotNegative(command.target_speed, "target_speed");
}

std::optional<RoutingTask> LaneFollowCommandProcessor::convert(const LaneFollowCommand& command) {
  const HdMap& map = context().requireRouter().map();
  RoutingTask task = beginRoutingTask(context(), command.header.frame_id, command.is_start_pose_set, command.way_point);
  setGoal(context(), command.header.frame_id, command.end_pose, "end_pose", &task);
  addBlackList(map, command.blacklisted_lane, command.blacklisted_road, &task);
  return task;
}

}  // namespace external_command
