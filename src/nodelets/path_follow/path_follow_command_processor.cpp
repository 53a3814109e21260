// SPDX-License-Identifier: Apache-2.0
#include "path_follow_command_processor.h"

#include <cmath>
#include <optional>
#include <utility>

#include "external_command/PathFollowAction.h"
#include "external_command/core/text.h"
#include "external_command/core/waypoint_path.h"
#include "external_command/ros/action_front.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/log_writer.h"
#include "path_border_checks.h"
#include "path_message.h"

namespace external_command {

namespace {

constexpr std::size_t kMaxBendWarnings = 20;
constexpr double kSameEndHeading = 0.05;  // [rad]
const WaypointNames kNamesOfMessage = {"poses", "the heading of poses", "the heading of the last of poses"};

WaypointLine toLine(const PathFollowCommand& command, const Pose2d& frame, const WaypointNames& names = {}) {
  WaypointLine line;
  line.names = names;
  line.points = toMapPoints(command.way_point, frame);
  for (const double heading : command.heading) line.headings.push_back(heading + frame.heading);
  if (command.has_end_heading) line.end_heading = command.end_heading + frame.heading;
  return line;
}

/// The command as the planner gets it: way points that repeat the one before are left out, with their borders and
/// headings.
PathFollowCommand withoutRepeats(const PathFollowCommand& command, const std::vector<Point2d>& points) {
  const std::vector<WaypointPlace> places = placesOf(points);
  if (places.size() == points.size()) return command;
  PathFollowCommand distinct = command;
  const auto thin = [&](auto* list, std::size_t WaypointPlace::*which) {
    if (list->empty()) return;
    for (std::size_t i = 0; i < places.size(); ++i) (*list)[i] = (*list)[places[i].*which];
    list->resize(places.size());
  };
  thin(&distinct.way_point, &WaypointPlace::first);
  thin(&distinct.heading, &WaypointPlace::last);
  thin(&distinct.left_boundary, &WaypointPlace::last);
  thin(&distinct.right_boundary, &WaypointPlace::last);
  return distinct;
}

std::string describe(const TightBend& bend, const WaypointNames& names, double min_radius) {
  const std::string place = text(names.point, "[", bend.waypoint, "], ", at(bend.position));
  const std::string needed =
      text("the vehicle needs a radius of ", metres(min_radius), " (~vehicle/min_turning_radius)");
  if (bend.corner == 0.0) {
    return text("the path bends with a radius of ", metres(bend.radius), " near ", place, "; ", needed);
  }
  const bool turns_back = std::abs(bend.corner) > 0.75 * M_PI;
  return text("the path has a corner of ", radians(std::abs(bend.corner)), " at ", place, "; ", needed,
              turns_back ? ", or headings that say where it reverses" : "");
}

void warnOfTightBends(const std::vector<TightBend>& bends, const WaypointNames& names, double min_radius,
                      std::vector<std::string>* warnings) {
  for (std::size_t i = 0; i < bends.size() && i < kMaxBendWarnings; ++i) {
    warnings->push_back(describe(bends[i], names, min_radius));
  }
  if (bends.size() <= kMaxBendWarnings) return;
  warnings->push_back(text(bends.size() - kMaxBendWarnings, " more places bend too tightly"));
}

/// Planners for vehicles that turn on the spot end with any heading.
void warnOfEndHeading(const WaypointPath& result, const WaypointNames& names, std::vector<std::string>* warnings) {
  if (std::abs(result.end_turn) < kSameEndHeading) return;
  const Pose2d end = result.path.back().pose();
  warnings->push_back(
      text("the path ends at ", at(end), " with a heading of ", radians(end.heading), ", not with ",
           radians(normalizeAngle(end.heading + result.end_turn)), " (", names.end_heading,
           "): the vehicle cannot turn there; let the last points lead into that heading, or plan with free_space"));
}

}  // namespace

PathFollowCommandProcessor::PathFollowCommandProcessor()
    : MotionCommandProcessor<PathFollow>("external_command/path_follow") {
  offerAction<PathFollowAction>();
}

PathFollowCommandProcessor::~PathFollowCommandProcessor() {
  path_subscriber_.shutdown();
  stopServing();
}

void PathFollowCommandProcessor::start() {
  MotionCommandProcessor<PathFollow>::start();
  start_limits_.read(parameters(), "start");
  if (start_limits_.refusal > 0.0) needsPose();
}

void PathFollowCommandProcessor::open() {
  MotionCommandProcessor<PathFollow>::open();
  std::string topic;
  parameters().readName("input_path_name", &topic);
  if (topic.empty()) return;
  ros::NodeHandle nh(getNodeHandle());
  nh.setCallbackQueue(executor().queue());
  const auto on_path = [this](const ros::MessageEvent<nav_msgs::Path const>& event) { takePath(event); };
  path_subscriber_ = subscribeBounded<nav_msgs::Path>(nh, topic, 10, on_path, context().params().requests);
}

void PathFollowCommandProcessor::takePath(const ros::MessageEvent<nav_msgs::Path const>& event) {
  const nav_msgs::Path& path = *event.getConstMessage();
  PathFollowCommand command;
  command.header = path.header;
  try {
    command = toPathFollowCommand(path, [this](const std::string& f) { return context().vehiclePose().ofFrame(f); });
    checkLine(command, kNamesOfMessage);
  } catch (const Error&) {
    CommandLogEntry entry;
    entry.header.stamp = ros::Time::now();
    entry.caller = event.getPublisherName();
    entry.reply = refuse(command.command_id);
    entry.request = packAny(command);
    if (isLogged()) log(std::move(entry));
    return;
  }
  const PathFollow::Response response = carryOutOfMessage(command, event.getPublisherName());
  if (response.report.warnings.empty()) return;
  std::string line = text("path_follow ", response.status.command_id, " has warnings: ");  // nobody is answered
  for (const std::string& warning : response.report.warnings) {
    line += (&warning == &response.report.warnings.front() ? "" : "; ") + warning;
  }
  logLater(LogLevel::kWarn, path_warnings_, line);
}

PathFollow::Response PathFollowCommandProcessor::carryOutOfMessage(const PathFollowCommand& command,
                                                                   const std::string& caller) {
  std::int64_t id = 0;
  PathFollow::Response response = process(command, caller, [&](const AdmittedCommand& admitted) {
    id = admitted.id;
    const std::lock_guard<std::mutex> lock(mutex_);
    of_messages_.insert(id);
  });
  const std::lock_guard<std::mutex> lock(mutex_);
  of_messages_.erase(id);
  return response;
}

WaypointNames PathFollowCommandProcessor::namesOf(std::int64_t command_id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return of_messages_.count(command_id) > 0 ? kNamesOfMessage : WaypointNames();
}

void PathFollowCommandProcessor::check(const PathFollowCommand& command) const {
  checkLine(command, {});
  requireFinite(command.end_heading, "end_heading");  // it goes on, used or not
  checkBorders(command);
  requireTargetSpeed(command.target_speed);
}

void PathFollowCommandProcessor::checkLine(const PathFollowCommand& command, const WaypointNames& names) const {
  checkPoints(command.way_point, 2, names.point);
  const ContextParams& params = context().params();
  const Pose2d frame = context().vehiclePose().ofFrame(command.header.frame_id);
  checkWaypoints(toLine(command, frame, names), params.reference_path.spacing, params.path_bounds);
}

/// Where the vehicle is need not be known to follow a path.
void PathFollowCommandProcessor::checkStart(const Point2d& start, std::vector<std::string>* warnings) const {
  std::optional<Pose2d> vehicle;
  try {
    vehicle = context().vehiclePose().get();
  } catch (const NotReady&) {
    if (start_limits_.refusal > 0.0) throw;
  }
  if (vehicle) start_limits_.check("the path begins at", "start", start, vehicle->position(), warnings);
}

void PathFollowCommandProcessor::processSpecialCommand(const PathFollowCommand& command, const CancelToken& cancel,
                                                       MotionPlan* plan) {
  const ContextParams& params = context().params();
  const Pose2d frame = context().vehiclePose().ofFrame(command.header.frame_id);
  const WaypointLine line = toLine(command, frame, namesOf(command.command_id));
  checkStart(line.points.front(), &plan->report.warnings);
  WaypointPath result = pathThrough(line, params.vehicle, params.reference_path.spacing, command.target_speed,
                                    params.path_bounds, cancel);
  warnOfBorders(command, params.vehicle.width, &plan->report.warnings);
  warnOfTightBends(result.tight_bends, line.names, params.vehicle.min_turning_radius, &plan->report.warnings);
  warnOfEndHeading(result, line.names, &plan->report.warnings);
  plan->path = std::move(result.path);
  plan->command.command_type = PlanningCommand::CUSTOM;
  plan->command.custom_command = packAny(withoutRepeats(command, line.points));
  plan->scene.way_points = line.points;
  plan->scene.start = plan->path.front().pose();
  plan->scene.goal = plan->path.back().pose();
}

}  // namespace external_command
