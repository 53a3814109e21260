// SPDX-License-Identifier: Apache-2.0
#include "free_space_command_processor.h"

#include "external_command/FreeSpaceAction.h"
#include "external_command/ros/action_front.h"
#include "external_command/ros/checks.h"

namespace external_command {

namespace {

Region::Parts partsOf(const FreeSpaceCommand& command, const Pose2d& frame, const CancelToken& cancel) {
  Region::Parts parts;
  if (!command.drivable_roi.points.empty()) {
    parts.drivable = toPolygon(command.drivable_roi, frame, "drivable_roi");
  }
  parts.non_drivable = toObstacles(command.non_drivable_roi, frame, cancel);
  return parts;
}

}  // namespace

FreeSpaceCommandProcessor::FreeSpaceCommandProcessor()
    : MotionCommandProcessor<FreeSpace>("external_command/free_space") {
  offerAction<FreeSpaceAction>();
}

FreeSpaceCommandProcessor::~FreeSpaceCommandProcessor() { stopServing(); }

double FreeSpaceCommandProcessor::planningTime(const FreeSpaceCommand& /*command*/, const Pose2d& /*vehicle*/) const {
  return planner_->params().time_budget;
}

void FreeSpaceCommandProcessor::start() {
  MotionCommandProcessor<FreeSpace>::start();
  planner_.emplace(getNodeHandle(), parameters(), context());
  needsPose();
  if (planner_->hasGrid()) needs("obstacle_grid", [this] { return planner_->gridWords(); });
  goal_limits_.read(parameters(), "goal");
}

void FreeSpaceCommandProcessor::check(const FreeSpaceCommand& command) const {
  requireSendable(command.parking_spot_pose, "parking_spot_pose");
  if (!command.parking_spot_pose.has_heading) {
    throw InvalidRequest("parking_spot_pose.has_heading is false; a parking pose needs a heading");
  }
  checkPolygons(command.non_drivable_roi, "non_drivable_roi", context().params().requests);
  if (!command.drivable_roi.points.empty())
    checkPolygon(command.drivable_roi, "drivable_roi", context().params().requests);
  requireTargetSpeed(command.target_speed);
  partsOf(command, {}, {});  // polygons that cross themselves
}

Pose2d FreeSpaceCommandProcessor::goalOf(const FreeSpaceCommand& command, const PlanStart& start,
                                         std::vector<std::string>* warnings) const {
  const Pose2d goal = toMapPose(command.parking_spot_pose, context().vehiclePose().ofFrame(command.header.frame_id));
  goal_limits_.check("parking_spot_pose is at", "goal", goal.position(), start.pose().position(), warnings);
  return goal;
}

/// Drives no lanes, but tells what is wrong before that disturbs another command that is being planned.
std::optional<RoutingTask> FreeSpaceCommandProcessor::convert(const FreeSpaceCommand& command, const PlanStart& start) {
  std::vector<std::string> told_by_the_plan;
  goalOf(command, start, &told_by_the_plan);
  if (planner_->hasGrid()) planner_->gridWords();
  return std::nullopt;
}

void FreeSpaceCommandProcessor::processSpecialCommand(const FreeSpaceCommand& command, const CancelToken& cancel,
                                                      MotionPlan* plan) {
  const Deadline deadline = planner_->deadline();
  const Pose2d frame = context().vehiclePose().ofFrame(command.header.frame_id);
  const Pose2d start = plan->start.pose();
  const Pose2d goal = goalOf(command, plan->start, &plan->report.warnings);
  const Region region = planner_->regionOf(partsOf(command, frame, cancel));

  plan->scene.start = start;
  plan->scene.goal = goal;
  planner_->append(planner_->plan(start, {goal}, region, deadline, cancel, plan->scene, {}, plan->take_over), plan);
  showRegion(region, &plan->scene);
  plan->command.command_type = PlanningCommand::CUSTOM;
  plan->command.custom_command = packAny(command);
}

}  // namespace external_command
