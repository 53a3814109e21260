// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/motion_flow.h"

#include <nav_msgs/Path.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "external_command/RoutingResponse.h"
#include "external_command/core/text.h"
#include "external_command/ros/conversions.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/motion_bytes.h"
#include "external_command/ros/process_context.h"
#include "external_command/ros/status.h"
#include "external_command/routing/reference_paths.h"

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

/// Where on the first leg of `path` the vehicle is that has moved by `moved` [m]; nullopt where it is beside it.
std::optional<std::size_t> placeOnFirstLeg(const Path& path, const Pose2d& vehicle, double moved) {
  constexpr double kBeside = 1.0;                          // [m]
  constexpr double kTurned = 0.6;                          // [rad]
  const double last = path.front().s + 1.5 * moved + 5.0;  // a later stretch may come by here again
  std::optional<std::size_t> place;
  double nearest = kBeside;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path[i].s > last || (i > 0 && path[i].direction != path[1].direction)) break;
    const double distance = (path[i].pose().position() - vehicle.position()).norm();
    if (distance > nearest || std::abs(angleBetween(path[i].heading, vehicle.heading)) > kTurned) continue;
    nearest = distance;
    place = i;
  }
  return place;
}

/// A part of a path that was sent: its limits as caps, its stops left to the whole that it becomes a piece of.
Path asPiece(Path sent) {
  for (ReferencePoint& point : sent) {
    if (point.speed <= 0.0) point.speed = std::numeric_limits<double>::infinity();
  }
  return sent;
}

/// Where the vehicle is there already it still gets a path, and not one of equal points, which has no direction.
void giveLength(Path* path) {
  constexpr double kLength = 0.01;  // [m]
  if (path->back().s - path->front().s >= kLength) return;
  path->resize(1);
  ReferencePoint end = path->front();
  end.x += kLength * std::cos(end.heading);
  end.y += kLength * std::sin(end.heading);
  end.s += kLength;
  end.direction = path->front().direction = Direction::kForward;
  path->push_back(end);
}

/// A cap of 0 would be taken for an order to stop, and the vehicle would wait there for ever.
void requireMotion(const Path& path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i].speed > 0.0) continue;
    throw InternalError(text("point ", i, " of the planned path, ", at(path[i].pose()), ", has the speed ",
                             path[i].speed, "; a cap must be above 0"));
  }
}

}  // namespace

MotionFlow::MotionFlow(ProcessContext& context, const std::vector<std::string>& command_topics,
                       const std::string& history_topic)
    : context_(context) {
  for (const std::string& topic : command_topics) {
    publishers_.commands.push_back(context.advertise<PlanningCommand>(topic, true));
  }
  publishers_.history = context.advertise<PlanningCommand>(history_topic, false);
  publishers_.routing = context.advertise<RoutingResponse>(context.params().routing_response_topic, true);
  publishers_.path = context.advertise<nav_msgs::Path>(context.params().path_topic, true);
}

/// Off the lanes the path begins on one, until the way there is planned.
std::optional<Pose2d> MotionFlow::startOnLane(const RoutingTask& task) const {
  if (!task.vehicle) return std::nullopt;
  const LaneWayTool tool(context_.requireRouter().map(), context_.params().lane_way);
  return tool.isOffLane(*task.vehicle, context_.vehiclePose().height()) ? std::nullopt : task.vehicle;
}

Route MotionFlow::routeOf(const RoutingTask& task, const CancelToken& cancel) const {
  Route route = task.route ? *task.route : context_.requireRouter().findRoute(task.query, cancel);
  context_.params().path_bounds.require(route.distance, route.distance / context_.params().reference_path.spacing);
  return route;
}

void MotionFlow::addRoute(const RoutingTask& task, double target_speed, const CancelToken& cancel,
                          MotionPlan* plan) const {
  const HdMap& map = context_.requireRouter().map();
  plan->route = routeOf(task, cancel);
  ReferencePath path = context_.requireReferencePaths().find(*plan->route, {target_speed, startOnLane(task), cancel});
  plan->path = std::move(path.path);
  const std::vector<std::string> tight = describe(map, path.tight, context_.params().vehicle);
  plan->report.warnings.insert(plan->report.warnings.end(), tight.begin(), tight.end());
  const std::vector<std::string> left = describe(map, path.left);
  plan->report.warnings.insert(plan->report.warnings.end(), left.begin(), left.end());
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

void MotionFlow::assemble(double target_speed, bool begins_at_vehicle, const CancelToken& cancel,
                          MotionPlan* plan) const {
  if (plan->path.empty()) throw InternalError("the command was planned, but its path is empty");
  const Path& approach = plan->start.approach();
  if (begins_at_vehicle && !approach.empty()) {
    const std::size_t planned = plan->path.size();
    plan->path = join(asPiece(approach), plan->path);
    plan->index_shift = static_cast<std::ptrdiff_t>(plan->path.size()) - static_cast<std::ptrdiff_t>(planned);
  }
  giveLength(&plan->path);
  const ContextParams& params = context_.params();
  params.path_bounds.require(plan->path);
  requireMotion(plan->path);
  const Pose2d from = plan->start.isKnown() ? plan->start.pose() : plan->path.front().pose();
  params.limits.requireGoal(from.position(), plan->path.back().pose().position());
  params.limits.requireInside(plan->path, params.vehicle, cancel);
  for (const double cap : {target_speed, params.limits.max_speed}) {
    if (cap <= 0.0) continue;
    for (ReferencePoint& point : plan->path) point.speed = std::min(point.speed, cap);
  }
}

bool MotionFlow::fitToVehicle(const Pose2d& seen_at, MotionPlan* plan) const {
  const Pose2d now = context_.vehiclePose().get();
  const double moved = (now.position() - seen_at.position()).norm();
  if (moved <= context_.params().max_start_shift) return true;
  const std::optional<std::size_t> place = placeOnFirstLeg(plan->path, now, moved);
  if (!place) return false;
  plan->path.erase(plan->path.begin(), plan->path.begin() + static_cast<std::ptrdiff_t>(*place));
  plan->index_shift -= static_cast<std::ptrdiff_t>(*place);
  setArcLengths(&plan->path);
  plan->scene.start = plan->path.front().pose();
  return true;
}

void MotionFlow::warnOfStart(const Pose2d& vehicle, MotionPlan* plan) {
  constexpr double kNear = 5.0;  // [m]
  const Pose2d start = plan->path.front().pose();
  const double distance = (start.position() - vehicle.position()).norm();
  if (distance <= kNear) return;
  plan->report.warnings.push_back(text("the path begins at ", at(start), ", as the command says (is_start_pose_set), ",
                                       metres(distance), " from the vehicle at ", at(vehicle)));
}

void MotionFlow::complete(std::int64_t command_id, double target_speed, MotionPlan* plan) const {
  limitSpeeds(context_.params().vehicle, &plan->path);
  PlanningCommand& command = plan->command;
  command.header.stamp = context_.gate().stamp();
  command.header.frame_id = context_.params().map_frame;
  command.command_id = command_id;
  command.is_motion_command = true;
  command.target_speed = target_speed;
  command.path.header = command.header;
  command.lane_follow_command.header = command.header;
  plan->report.path_length = plan->path.back().s;
  plan->report.reverse_length = reverseLength(plan->path);
  plan->report.gear_changes = gearChanges(plan->path);
}

/// A planner that follows the path gets it like the command; everybody else sees it later.
void MotionFlow::send(const CommandGate::Ticket& ticket, MotionPlan&& plan) const {
  const auto path = std::make_shared<const Path>(std::move(plan.path));
  const PreparedBytes command = bytesOf(plan.command, *path);
  std::vector<PreparedMessage> messages;
  for (const ros::Publisher& publisher : publishers_.commands) messages.emplace_back(publisher, command);
  messages.emplace_back(publishers_.history, command);
  const bool has_path = context_.params().planner_follows_path;
  if (has_path) messages.emplace_back(publishers_.path, navPathBytesOf(*path, plan.command.header));

  const AdmittedCommand& sent = ticket.command();
  auto topics = std::make_shared<MotionTopics>(publishers_, std::move(plan.command), has_path ? nullptr : path);
  const auto motion = std::make_shared<const SentMotion>(SentMotion{sent, path, plan.index_shift, std::move(topics)});

  const std::lock_guard<std::mutex> in_order(context_.sendingMutex());
  const auto replaced = context_.gate().commit(ticket, motion, [&] {
    context_.registry().markSent(sent.serial, "sent");
    for (const PreparedMessage& message : messages) message.send();
  });
  if (replaced) {
    context_.registry().update(
        {replaced->command.serial, makeStatus(replaced->command.id, CommandStatus::ERROR, ErrorCode::kSuperseded,
                                              text("superseded by command ", sent.id))});
  }
  try {
    if (plan.on_sent) plan.on_sent(*motion);
    context_.sentMotions()(*motion);
  } catch (const std::exception& error) {
    logLater(LogLevel::kError,
             text("command ", sent.id, " was sent, but what follows from that failed: ", error.what()));
  }
  plan.scene.route = std::move(plan.route);
  plan.scene.path = path;
  context_.display().show(std::move(plan.scene));
  context_.showSentLater();
}

std::string MotionFlow::plannerWords() const {
  const ContextParams& params = context_.params();
  const std::vector<ros::Publisher> heard =
      params.planner_follows_path ? std::vector<ros::Publisher>{publishers_.path} : publishers_.commands;
  const auto isListenedTo = [](const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; };
  const auto listened = std::find_if(heard.begin(), heard.end(), isListenedTo);
  if (listened == heard.end()) {
    throw NotReady(text("nobody listens to ", heard.front().getTopic(), "; is the planner running?"));
  }
  const bool should_report = !params.planner_follows_path && params.motion_watch.arrival != ArrivalSource::kPose;
  const auto motion = context_.gate().motion();
  const double limit = params.planner_silence_timeout;
  if (should_report && motion && context_.registry().silenceOf(motion->command.serial) >= limit) {
    throw NotReady(text("command ", motion->command.id, ": ", silenceWords(limit)));
  }
  return text("somebody listens to ", listened->getTopic(),
              context_.hasPlannerReported() ? ", and reports" : "; nothing was reported yet");
}

double MotionFlow::cappedSpeed(double target_speed, PlanReport* report) const {
  context_.params().limits.requireSpeed(target_speed);
  const double limit = context_.params().vehicle.max_speed;
  if (target_speed <= limit) return target_speed;
  report->warnings.push_back(text("target_speed ", target_speed, " m/s is above the vehicle's ", limit,
                                  " m/s (~vehicle/max_speed); lowered to that"));
  return limit;
}

}  // namespace external_command
