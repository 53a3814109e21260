// SPDX-License-Identifier: Apache-2.0
#include <ros/console.h>

#include <algorithm>

#include "external_command/core/text.h"
#include "external_command/ros/motion_command_processor.h"

namespace external_command {

namespace {

void reportRoute(const HdMap& map, const Route& route, PlanReport* report) {
  report->route_length = route.distance;
  for (const RouteStep& step : route.steps) {
    report->lane_ids.push_back(map.lane(step.lane).id);
    report->lane_changes += step.change_after != LaneChange::kNone;
  }
  report->warnings.insert(report->warnings.end(), route.warnings.begin(), route.warnings.end());
}

}  // namespace

void requireNotMore(std::size_t dry_runs, std::size_t limit) {
  if (dry_runs <= limit) return;
  throw NotReady(
      text(limit, " dry runs are in work at this service, the most there may be; wait for the answer to one"));
}

MotionFlow::MotionFlow(ProcessContext& context, const std::vector<std::string>& command_topics,
                       const std::string& history_topic)
    : context_(context),
      history_publisher_(context.advertise<PlanningCommand>(history_topic, false)),
      routing_publisher_(context.advertise<RoutingResponse>(context.params().routing_response_topic, true)) {
  for (const std::string& topic : command_topics) {
    command_publishers_.push_back(context.advertise<PlanningCommand>(topic, true));
  }
}

void MotionFlow::addRoute(const RoutingTask& task, double target_speed, const CancelToken& cancel,
                          MotionPlan* plan) const {
  const Router& router = context_.requireRouter();
  const HdMap& map = router.map();
  plan->route = router.findRoute(task.query, cancel);
  plan->path =
      referencePath(map, *plan->route, context_.params().vehicle, context_.params().reference_path, target_speed);
  RoutingResponse& response = plan->command.lane_follow_command;
  response = toRoutingResponse(map, *plan->route);
  response.routing_request = requestOf(map, task, *plan->route);
  response.map_version = map.version();
  plan->command.has_lane_follow_command = true;
  plan->scene.way_points = task.way_points;
  plan->scene.start = plan->path.front().pose();
  plan->scene.goal = plan->path.back().pose();
  plan->report.warnings.insert(plan->report.warnings.end(), task.warnings.begin(), task.warnings.end());
  reportRoute(map, *plan->route, &plan->report);
}

void MotionFlow::complete(std::int64_t command_id, double target_speed, MotionPlan* plan) const {
  if (plan->path.empty()) throw InternalError("the command was planned, but its path is empty");
  if (plan->path.size() == 1) plan->path.push_back(plan->path.front());  // the vehicle is there; still a path
  if (target_speed > 0.0) {
    for (ReferencePoint& point : plan->path) point.speed = std::min(point.speed, target_speed);
  }
  PlanningCommand& command = plan->command;
  command.header.stamp = ros::Time::now();
  command.header.frame_id = context_.params().map_frame;
  command.command_id = command_id;
  command.is_motion_command = true;
  command.target_speed = target_speed;
  command.path = toMsg(plan->path);
  command.path.header = command.header;
  command.lane_follow_command.header = command.header;
  plan->report.path_length = plan->path.back().s;
  plan->report.reverse_length = reverseLength(plan->path);
  plan->report.gear_changes = gearChanges(plan->path);
}

void MotionFlow::send(const CommandGate::Ticket& ticket, MotionPlan&& plan) const {
  const PlanningCommand& command = plan.command;
  const std::int64_t id = command.command_id;
  const auto replaced = context_.gate().commit(ticket, [&] {
    context_.registry().markSent(id, "sent");
    for (const ros::Publisher& publisher : command_publishers_) publisher.publish(command);
    history_publisher_.publish(command);
    if (command.has_lane_follow_command) routing_publisher_.publish(command.lane_follow_command);
  });
  if (replaced && *replaced != id) {
    context_.registry().update(
        makeStatus(*replaced, CommandStatus::ERROR, ErrorCode::kSuperseded, text("superseded by command ", id)));
  }
  plan.scene.route = std::move(plan.route);
  plan.scene.path = std::move(plan.path);
  context_.display().show(std::move(plan.scene));
}

double MotionFlow::cappedSpeed(double target_speed, PlanReport* report) const {
  const double limit = context_.params().vehicle.max_speed;
  if (target_speed <= limit) return target_speed;
  report->warnings.push_back(text("target_speed ", target_speed, " m/s is above the vehicle's ", limit,
                                  " m/s (~vehicle/max_speed); lowered to that"));
  return limit;
}

}  // namespace external_command
