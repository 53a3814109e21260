// SPDX-License-Identifier: Apache-2.0
#include "goal_pose_service.h"

#include <ros/service_manager.h>

#include <utility>

#include "external_command/FreeSpace.h"
#include "external_command/LaneFollow.h"
#include "external_command/PreciseParking.h"
#include "external_command/core/error.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

Pose toMsg(const Pose2d& pose, bool has_heading) {
  Pose message;
  message.x = pose.x;
  message.y = pose.y;
  message.heading = has_heading ? pose.heading : 0.0;
  message.has_heading = has_heading;
  return message;
}

template <class Command>
void setStart(const std::optional<Pose2d>& start, Command* command) {
  if (!start) return;
  command->is_start_pose_set = true;
  command->way_point = {toMsg(*start, true)};
}

void fill(const GoalPoseService::Goal& goal, LaneFollowCommand* command) {
  setStart(goal.start, command);
  command->end_pose = toMsg(goal.pose, goal.has_heading);
}

void fill(const GoalPoseService::Goal& goal, FreeSpaceCommand* command) {
  if (goal.start) throw InvalidRequest("free_space plans from where the vehicle is; leave start.header.frame_id empty");
  command->parking_spot_pose = toMsg(goal.pose, true);
}

void fill(const GoalPoseService::Goal& goal, PreciseParkingCommand* command) {
  setStart(goal.start, command);
  command->parking_spot_pose = toMsg(goal.pose, true);
  command->parking_inwards = true;
}

template <class Service>
class GoalPoseServiceT : public GoalPoseService {
 public:
  explicit GoalPoseServiceT(const std::string& name) : GoalPoseService(name) {}

 private:
  Answer callService(ros::NodeHandle& nh, const std::string& name, const Goal& goal,
                     const ros::M_string& header) const override {
    Service service;
    auto& command = service.request.command;
    command.command_id = goal.command_id;
    command.dry_run = goal.dry_run;
    fill(goal, &command);
    if (!nh.serviceClient<Service>(name, false, header).call(service)) {
      throw InternalError(text("service ", name, " ended without an answer; see the component's log"));
    }
    return {std::move(service.response.status), std::move(service.response.report.warnings),
            std::move(service.response.path)};
  }
};

}  // namespace

std::unique_ptr<GoalPoseService> GoalPoseService::make(const std::string& kind, const std::string& name) {
  if (kind == "lane_follow") return std::make_unique<GoalPoseServiceT<LaneFollow>>(name);
  if (kind == "free_space") return std::make_unique<GoalPoseServiceT<FreeSpace>>(name);
  if (kind == "precise_parking") return std::make_unique<GoalPoseServiceT<PreciseParking>>(name);
  throw InvalidParameter(
      text("~service is ", quoted(kind), "; give lane_follow, free_space or precise_parking, which drive to a pose"));
}

GoalPoseService::Answer GoalPoseService::call(ros::NodeHandle& nh, const Goal& goal,
                                              const ros::M_string& header) const {
  const std::string name = nh.resolveName(name_);
  if (!ros::ServiceManager::instance()->lookupServicePublication(name)) {
    throw NotReady(text("there is no service ", name,
                        " in this process (~service, ~service_name): is its processor in ",
                        "the component's list, and this adapter loaded into the component's process?"));
  }
  return callService(nh, name, goal, header);
}

}  // namespace external_command
