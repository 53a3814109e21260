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
#include "path_message.h"

namespace external_command {

namespace {

constexpr std::size_t kMaxBendWarnings = 20;
constexpr double kSameEndHeading = 0.05;  // [rad]

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

void requireSameCount(std::size_t size, std::size_t way_points, const std::string& field) {
  if (size == way_points) return;
  throw InvalidRequest(text(field, " has ", size, " points, way_point ", way_points,
                            "; each border needs one point per way point, or give left_path_width and "
                            "right_path_width instead"));
}

void checkBorders(const PathFollowCommand& command) {
  requireNotNegative(command.left_path_width, "left_path_width");
  requireNotNegative(command.right_path_width, "right_path_width");
  const bool has_widths = command.left_path_width > 0.0 || command.right_path_width > 0.0;
  const bool has_boundaries = !command.left_boundary.empty() || !command.right_boundary.empty();
  if (has_widths && has_boundaries) {
    throw InvalidRequest(text("left_boundary has ", command.left_boundary.size(), " points, right_boundary ",
                              command.right_boundary.size(), ", and left_path_width is ", command.left_path_width,
                              ", right_path_width ", command.right_path_width,
                              "; give boundaries or widths, not both"));
  }
  if (has_widths && (command.left_path_width == 0.0 || command.right_path_width == 0.0)) {
    throw InvalidRequest(text("left_path_width is ", command.left_path_width, ", right_path_width ",
                              command.right_path_width, "; give both or neither"));
  }
  if (!has_boundaries) return;
  requireSameCount(command.left_boundary.size(), command.way_point.size(), "left_boundary");
  requireSameCount(command.right_boundary.size(), command.way_point.size(), "right_boundary");
  checkPoints(command.left_boundary, 2, "left_boundary");
  checkPoints(command.right_boundary, 2, "right_boundary");
}

/// Where the given borders leave less room than the vehicle's width.
void warnOfNarrowPath(const PathFollowCommand& command, double vehicle_width, std::vector<std::string>* warnings) {
  const auto warn = [&](const std::string& what, double width) {
    warnings->push_back(text(what, " leave ", metres(width), " between them; the vehicle is ", metres(vehicle_width),
                             " wide (~vehicle/width)"));
  };
  const double width = command.left_path_width + command.right_path_width;
  if (width > 0.0 && width < vehicle_width) warn("left_path_width and right_path_width", width);
  for (std::size_t i = 0; i < command.left_boundary.size(); ++i) {
    const auto &left = command.left_boundary[i], &right = command.right_boundary[i];
    const double gap = std::hypot(left.x - right.x, left.y - right.y);
    if (gap >= vehicle_width) continue;
    return warn(text("left_boundary[", i, "] and right_boundary[", i, "]"), gap);
  }
}

std::string describe(const TightBend& bend, double min_radius) {
  const std::string place = text("way_point[", bend.waypoint, "], ", at(bend.position));
  const std::string needed =
      text("the vehicle needs a radius of ", metres(min_radius), " (~vehicle/min_turning_radius)");
  if (bend.corner == 0.0) {
    return text("the path bends with a radius of ", metres(bend.radius), " near ", place, "; ", needed);
  }
  const bool turns_back = std::abs(bend.corner) > 0.75 * M_PI;
  return text("the path has a corner of ", radians(std::abs(bend.corner)), " at ", place, "; ", needed,
              turns_back ? ", or headings that say where it reverses" : "");
}

void warnOfTightBends(const std::vector<TightBend>& bends, double min_radius, std::vector<std::string>* warnings) {
  for (std::size_t i = 0; i < bends.size() && i < kMaxBendWarnings; ++i) {
    warnings->push_back(describe(bends[i], min_radius));
  }
  if (bends.size() <= kMaxBendWarnings) return;
  warnings->push_back(text(bends.size() - kMaxBendWarnings, " more places bend too tightly"));
}

/// Planners for vehicles that turn on the spot end with any heading.
void warnOfEndHeading(const WaypointPath& result, std::vector<std::string>* warnings) {
  if (std::abs(result.end_turn) < kSameEndHeading) return;
  const Pose2d end = result.path.back().pose();
  warnings->push_back(
      text("the path ends at ", at(end), " with a heading of ", radians(end.heading), ", not with ",
           radians(normalizeAngle(end.heading + result.end_turn)), " (end_heading): the vehicle ",
           "cannot turn there; let the last way points lead into that heading, or plan with free_space"));
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
    checkLine(command, {"poses", "the heading of poses"});
  } catch (const Error&) {
    CommandLogEntry entry;
    entry.header.stamp = ros::Time::now();
    entry.caller = event.getPublisherName();
    entry.reply = refuse(command.command_id);
    entry.request = packAny(command);
    if (isLogged()) log(std::move(entry));
    return;
  }
  process(command, event.getPublisherName());
}

void PathFollowCommandProcessor::check(const PathFollowCommand& command) const {
  checkLine(command, {});
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
  const WaypointLine line = toLine(command, frame);
  checkStart(line.points.front(), &plan->report.warnings);
  WaypointPath result = pathThrough(line, params.vehicle, params.reference_path.spacing, command.target_speed,
                                    params.path_bounds, cancel);
  warnOfNarrowPath(command, params.vehicle.width, &plan->report.warnings);
  warnOfTightBends(result.tight_bends, params.vehicle.min_turning_radius, &plan->report.warnings);
  warnOfEndHeading(result, &plan->report.warnings);
  plan->path = std::move(result.path);
  plan->command.command_type = PlanningCommand::CUSTOM;
  plan->command.custom_command = packAny(withoutRepeats(command, line.points));
  plan->scene.way_points = line.points;
  plan->scene.start = plan->path.front().pose();
  plan->scene.goal = plan->path.back().pose();
}

}  // namespace external_command
