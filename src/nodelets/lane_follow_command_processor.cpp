// SPDX-License-Identifier: Apache-2.0
#include "lane_follow_command_processor.h"

#include "external_command/LaneFollowAction.h"
#include "external_command/ros/action_front.h"
#include "nodelets/manoeuvres/parking_manoeuvres.h"

namespace external_command {

LaneFollowCommandProcessor::LaneFollowCommandProcessor()
    : MotionCommandProcessor<LaneFollow>("external_command/lane_follow") {
  offerAction<LaneFollowAction>();
}

LaneFollowCommandProcessor::~LaneFollowCommandProcessor() { stopServing(); }

void LaneFollowCommandProcessor::start() {
  MotionCommandProcessor<LaneFollow>::start();
  planner_.emplace(getNodeHandle(), parameters(), context());
  needsMap();
  needsPose();
  if (planner_->hasGrid()) needs("obstacle_grid", [this] { return planner_->gridWords(); });
}

void LaneFollowCommandProcessor::check(const LaneFollowCommand& command) const {
  checkWayPoints(command.way_point, command.is_start_pose_set, context().params().requests);
  requireFinite(command.end_pose, "end_pose");
  checkBlackList(command.blacklisted_lane, command.blacklisted_road, context().params().requests);
  requireTargetSpeed(command.target_speed);
}

std::optional<RoutingTask> LaneFollowCommandProcessor::convert(const LaneFollowCommand& command,
                                                               const PlanStart& start) {
  const HdMap& map = context().requireRouter().map();
  RoutingTask task =
      beginRoutingTask(context(), start, command.header.frame_id, command.is_start_pose_set, command.way_point);
  setGoal(context(), command.header.frame_id, command.end_pose, "end_pose", &task);
  addBlackList(map, command.blacklisted_lane, command.blacklisted_road, &task);
  return task;
}

/// Only the way out of a parking place takes longer.
bool LaneFollowCommandProcessor::isPlannedAtOnce(const LaneFollowCommand& command) const {
  if (command.is_start_pose_set) return true;
  const PlanStart start = context().motionWatch().startFor(0.0);
  const LaneWayTool lanes(context().requireRouter().map(), context().params().lane_way);
  return !start.isKnown() || !lanes.isOffLane(start.pose(), context().vehiclePose().height());
}

void LaneFollowCommandProcessor::processSpecialCommand(const LaneFollowCommand& command, const CancelToken& cancel,
                                                       MotionPlan* plan) {
  if (command.is_start_pose_set) return;
  leaveParkingPlace(context(), plan->start.pose(), *planner_, planner_->deadline(), cancel, plan);
}

}  // namespace external_command
