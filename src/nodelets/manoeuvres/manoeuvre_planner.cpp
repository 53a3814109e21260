// SPDX-License-Identifier: Apache-2.0
#include "manoeuvre_planner.h"

#include <nav_msgs/OccupancyGrid.h>
#include <tf2/utils.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "external_command/core/text.h"
#include "external_command/motion/collision_checker.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/log_writer.h"
#include "path_joint.h"

namespace external_command {

struct ManoeuvrePlanner::LatestGrid {
  std::mutex mutex;
  nav_msgs::OccupancyGrid::ConstPtr message;
  ros::Time stamp;  ///< of the message, or when it came where it has none
};

struct ManoeuvrePlanner::PlacedGrid {
  nav_msgs::OccupancyGrid::ConstPtr message;
  OccupancyGrid outline;  ///< of the message, in the map: all but its cells
};

namespace {

constexpr double kLeastBudget = 2e-3;  // that planning can begin with [s]
constexpr double kWholeBudget = 0.95;  // share of the command's, from which on a part has had it all

OccupancyGrid outlineOf(const nav_msgs::OccupancyGrid& message, const Pose2d& frame, const ObstacleGridParams& params) {
  const auto& origin = message.info.origin;
  OccupancyGrid grid;
  grid.unknown_is_blocked = params.unknown_is_blocked;
  grid.outside_is_blocked = params.outside_is_blocked;
  grid.resolution = message.info.resolution;
  grid.width = message.info.width;
  grid.height = message.info.height;
  grid.origin = compose(frame, {origin.position.x, origin.position.y,
                                tf2::getYaw(tf2::Quaternion(origin.orientation.x, origin.orientation.y,
                                                            origin.orientation.z, origin.orientation.w))});
  return grid;
}

unsigned readCount(const ParameterReader& reader, const std::string& key, int low, unsigned fallback) {
  int value = static_cast<int>(fallback);
  reader.readWithin(key, low, 10000000, &value);
  return static_cast<unsigned>(value);
}

/// What OMPL tells of each plan is left out.
void logPlanner(PlannerLogLevel level, const std::string& message) {
  if (level < PlannerLogLevel::kWarning) return;
  logLater(level == PlannerLogLevel::kError ? LogLevel::kError : LogLevel::kWarn, "OMPL: " + message);
}

}  // namespace

std::string timeoutWords(const std::string& why, double part, double whole, const std::string& parameter) {
  if (part >= kWholeBudget * whole) return why;
  return text(why, "; the other parts of the command have the rest of its ", seconds(whole), " (~", parameter, ")");
}

FreeSpaceParams readFreeSpaceParams(const ParameterReader& reader) {
  FreeSpaceParams params;
  params.spacing = 0.1;
  reader.read("planner", &params.planner);
  reader.read("margin", &params.margin);
  reader.read("time_budget", &params.time_budget);
  reader.read("improve_budget", &params.improve_budget);
  params.max_iterations = readCount(reader, "max_iterations", 1, params.max_iterations);
  params.improve_iterations = readCount(reader, "improve_iterations", 0, params.improve_iterations);
  params.seed = readCount(reader, "seed", 0, params.seed);
  params.threads = readCount(reader, "threads", 1, params.threads);
  reader.read("gear_change_cost", &params.gear_change_cost);
  reader.read("reverse_factor", &params.reverse_factor);
  reader.read("steering_cost", &params.steering_cost);
  reader.read("closeness_cost", &params.closeness_cost);
  reader.read("closeness_distance", &params.closeness_distance);
  reader.read("path_spacing", &params.spacing);
  reader.read("continuous_curvature", &params.continuous_curvature);
  reader.read("manoeuvre_speed", &params.manoeuvre_speed);
  reader.validate(params);
  return params;
}

RegionLimits readRegionLimits(const ParameterReader& reader) {
  RegionLimits limits;
  reader.readSize("max_edges", 4, 100000000, &limits.max_edges);
  reader.readSize("max_near_edges", 4, 1000000000, &limits.max_near_edges);
  return limits;
}

ManoeuvrePlanner::ManoeuvrePlanner(ros::NodeHandle nh, const ParameterReader& reader, ProcessContext& context)
    : context_(context),
      params_(readFreeSpaceParams(reader.within("free_space"))),
      region_limits_(readRegionLimits(reader.within("free_space"))),
      latest_grid_(std::make_shared<LatestGrid>()),
      planner_log_(PlannerLog::acquire(logPlanner)) {
  reader.readName("obstacle_grid_name", &grid_params_.topic);
  reader.readWithin("max_grid_age", 0.0, 86400.0, &grid_params_.max_age);
  reader.read("grid_unknown_is_blocked", &grid_params_.unknown_is_blocked);
  reader.read("grid_outside_is_blocked", &grid_params_.outside_is_blocked);
  if (grid_params_.topic.empty()) return;
  nh.setCallbackQueue(context.housekeeping().queue());
  const auto keep = [latest = latest_grid_](const ros::MessageEvent<nav_msgs::OccupancyGrid const>& event) {
    const nav_msgs::OccupancyGrid::ConstPtr message = event.getConstMessage();
    const std::lock_guard<std::mutex> lock(latest->mutex);
    latest->message = message;
    latest->stamp = message->header.stamp.isZero() ? ros::Time::now() : message->header.stamp;
  };
  grid_subscriber_ =
      subscribeBounded<nav_msgs::OccupancyGrid>(nh, grid_params_.topic, 1, keep, context.params().requests);
}

ManoeuvrePlanner::~ManoeuvrePlanner() = default;

double ManoeuvrePlanner::bendLength() const { return external_command::bendLength(context_.params().vehicle, params_); }

ManoeuvrePlanner::PlacedGrid ManoeuvrePlanner::requireGrid() const {
  const std::string& topic = grid_params_.topic;
  nav_msgs::OccupancyGrid::ConstPtr message;
  ros::Time stamp;
  {
    const std::lock_guard<std::mutex> lock(latest_grid_->mutex);
    message = latest_grid_->message;
    stamp = latest_grid_->stamp;
  }
  if (!message) {
    throw NotReady(text("no obstacle grid has come on ", topic, " (~obstacle_grid_name); is it published?"));
  }
  requireFresh(stamp);
  Pose2d frame;
  try {
    frame = context_.vehiclePose().ofFrame(message->header.frame_id);
  } catch (const InvalidRequest& error) {
    throw NotReady(text("the obstacle grid on ", topic, " cannot be placed: ", error.what()));
  }
  PlacedGrid placed{message, outlineOf(*message, frame, grid_params_)};
  const std::string fault = gridFault(placed.outline, message->data.size());
  if (fault.empty()) return placed;
  throw NotReady(
      text("the obstacle grid on ", topic, " cannot be used: ", fault, "; what publishes it has to be mended"));
}

std::optional<OccupancyGrid> ManoeuvrePlanner::grid() const {
  if (!hasGrid()) return std::nullopt;
  PlacedGrid grid = requireGrid();
  grid.outline.cells = grid.message->data;
  return std::move(grid.outline);
}

std::string ManoeuvrePlanner::gridWords() const {
  requireGrid();
  return text("an obstacle grid comes on ", grid_params_.topic);
}

void ManoeuvrePlanner::requireFresh(ros::Time stamp) const {
  if (grid_params_.max_age <= 0.0) return;
  const double age = ros::Time::now().toSec() - stamp.toSec();
  if (age > grid_params_.max_age) {
    throw NotReady(text("the obstacle grid on ", grid_params_.topic, " is ", seconds(age), " old; the limit is ",
                        seconds(grid_params_.max_age), " (~max_grid_age; 0 takes it at any age)"));
  }
  const double max_ahead = context_.params().max_future_stamp;
  if (-age > max_ahead) {
    throw NotReady(text("the obstacle grid on ", grid_params_.topic, " is stamped ", seconds(-age),
                        " in the future; the limit is ", seconds(max_ahead),
                        " (~max_future_stamp of the component): do the clocks agree?"));
  }
}

Region ManoeuvrePlanner::regionOf(Region::Parts parts) const {
  parts.grid = grid();
  parts.limits = region_limits_;
  return Region(std::move(parts));
}

FreeSpacePlan ManoeuvrePlanner::plan(const Pose2d& start, const std::vector<Pose2d>& goals, const Region& region,
                                     const Deadline& deadline, const CancelToken& cancel, const CommandScene& scene,
                                     const EndStates& ends, const std::function<void()>& checked) const {
  FreeSpaceParams params = params_;
  params.time_budget = std::min(params_.time_budget, deadline.left());
  params.improve_budget *= params.time_budget / params_.time_budget;
  if (params.time_budget < kLeastBudget) {
    throw PlanningTimeout(text("the time of the command was used up before it was planned from ", at(start),
                               "; raise ~free_space/time_budget, which is ", seconds(params_.time_budget)));
  }
  try {
    return FreeSpacePlanner(context_.params().vehicle, params).plan(start, goals, region, cancel, ends, checked);
  } catch (const PlanningTimeout& error) {
    throw PlanningTimeout(
        timeoutWords(error.what(), params.time_budget, params_.time_budget, "free_space/time_budget"));
  } catch (const StartBlocked&) {
    showConflicts({start}, region, scene, cancel);
    throw;
  } catch (const GoalBlocked&) {
    showConflicts(goals, region, scene, cancel);
    throw;
  }
}

void ManoeuvrePlanner::showConflicts(const std::vector<Pose2d>& poses, const Region& region, CommandScene scene,
                                     const CancelToken& cancel) const {
  const CollisionChecker checker(context_.params().vehicle, params_.margin, region, cancel.checkpoint());
  showRegion(region, &scene);
  for (const Pose2d& pose : poses) {
    const auto collision = checker.collisionAt(pose);
    if (!collision) continue;
    const auto footprint = footprintAt(context_.params().vehicle, pose, params_.margin);
    scene.conflicts.emplace_back(footprint.begin(), footprint.end());
    if (collision->kind == Collision::Kind::kNonDrivable) {
      scene.conflicts.push_back(region.nonDrivable()[collision->index].points());
    } else if (collision->kind == Collision::Kind::kDrivableBorder) {
      scene.conflicts.push_back(region.drivable()->points());
    }
  }
  context_.display().showRefused(std::move(scene));
}

void ManoeuvrePlanner::append(const FreeSpacePlan& manoeuvre, MotionPlan* plan) const {
  plan->path = join(plan->path, manoeuvre.path, context_.params().vehicle);
  plan->report.min_clearance = plan->report.min_clearance > 0.0
                                   ? std::min(plan->report.min_clearance, manoeuvre.min_clearance)
                                   : manoeuvre.min_clearance;
  plan->report.wheel_turns += manoeuvre.wheel_turns;
  plan->report.near_length += manoeuvre.near_length;
  plan->report.warnings.insert(plan->report.warnings.end(), manoeuvre.warnings.begin(), manoeuvre.warnings.end());
  plan->scene.with_footprints = true;
}

void showRegion(const Region& region, CommandScene* scene) {
  if (region.drivable()) scene->regions.push_back(region.drivable()->points());
  for (const Polygon& polygon : region.nonDrivable()) scene->obstacles.push_back(polygon.points());
}

}  // namespace external_command
