// SPDX-License-Identifier: Apache-2.0
#include "precise_parking_command_processor.h"

#include <algorithm>

#include "external_command/PreciseParkingAction.h"
#include "external_command/core/text.h"
#include "external_command/motion/collision_checker.h"
#include "external_command/ros/action_front.h"
#include "external_command/routing/area_access.h"

namespace external_command {

namespace {

constexpr double kRounding = 1e-6;  // of a distance [m]

/// Straight from `from` over `length` [m], forward or in reverse.
Path straightPath(const Pose2d& from, double length, Direction direction, double spacing,
                  const VehicleParams& vehicle) {
  const double sign = signOf(direction);
  const int steps = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  Path path;
  for (int i = 0; i <= steps; ++i) {
    const double driven = length * i / steps;
    const Pose2d pose = compose(from, {sign * driven, 0.0, 0.0});
    ReferencePoint point;
    point.x = pose.x;
    point.y = pose.y;
    point.heading = from.heading;
    point.s = driven;
    point.direction = direction;
    point.speed = vehicle.max_speed;
    path.push_back(point);
  }
  return path;
}

}  // namespace

PreciseParkingCommandProcessor::PreciseParkingCommandProcessor()
    : MotionCommandProcessor<PreciseParking>("external_command/precise_parking") {
  offerAction<PreciseParkingAction>();
}

PreciseParkingCommandProcessor::~PreciseParkingCommandProcessor() { stopServing(); }

void PreciseParkingCommandProcessor::start() {
  MotionCommandProcessor<PreciseParking>::start();
  planner_.emplace(getNodeHandle(), parameters(), context());
  needsMap();
  needsPose();
  if (planner_->hasGrid()) needs("obstacle_grid", [this] { return planner_->gridWords(); });
  parameters().readWithin("straight_last", 0.1, 20.0, &straight_last_);
  parameters().readWithin("access_distance", 0.0, 100.0, &access_distance_);
}

void PreciseParkingCommandProcessor::check(const PreciseParkingCommand& command) const {
  checkWayPoints(command.way_point, command.is_start_pose_set, context().params().requests);
  requireSendable(command.way_point, "way_point");
  requireSendable(command.parking_spot_pose, "parking_spot_pose");
  if (!command.parking_spot_pose.has_heading) {
    throw InvalidRequest("parking_spot_pose.has_heading is false; a parking pose needs a heading");
  }
  if (command.mission_type > PreciseParkingCommand::DUMP) {
    throw InvalidRequest(text("mission_type is ", static_cast<int>(command.mission_type), "; give CHARGE 0 or DUMP 1"));
  }
  requireTargetSpeed(command.target_speed);
}

Pose2d PreciseParkingCommandProcessor::spotOf(const PreciseParkingCommand& command) const {
  return toMapPose(command.parking_spot_pose, context().vehiclePose().ofFrame(command.header.frame_id));
}

const Area& PreciseParkingCommandProcessor::areaOf(const PreciseParkingCommand& command) const {
  const HdMap& map = context().requireRouter().map();
  const Pose2d spot = spotOf(command);
  const Area* area = map.areaAt(spot.position());
  if (area != nullptr) return *area;
  throw InvalidRequest(text("parking_spot_pose ", at(spot), " lies in none of the ", map.areas().size(),
                            " areas of the map; precise parking needs one, free space does not"));
}

bool PreciseParkingCommandProcessor::needsNoLanes(const PreciseParkingCommand& command, const PlanStart& start) const {
  return !command.is_start_pose_set && command.way_point.empty() &&
         areaOf(command).polygon.contains(start.pose().position());
}

double PreciseParkingCommandProcessor::planningTime(const PreciseParkingCommand& command, const Pose2d& vehicle) const {
  return needsNoLanes(command, PlanStart(vehicle)) ? planner_->params().time_budget : 0.0;
}

std::optional<RoutingTask> PreciseParkingCommandProcessor::convert(const PreciseParkingCommand& command,
                                                                   const PlanStart& start) {
  const Area& area = areaOf(command);
  if (needsNoLanes(command, start)) return std::nullopt;
  const HdMap& map = context().requireRouter().map();
  RoutingTask task =
      beginRoutingTask(context(), start, command.header.frame_id, command.is_start_pose_set, command.way_point);
  setGoals(map, accessPoints(map, area, access_distance_), &task);
  return task;
}

void PreciseParkingCommandProcessor::processSpecialCommand(const PreciseParkingCommand& command,
                                                           const CancelToken& cancel, MotionPlan* plan) {
  const Deadline deadline = planner_->deadline();
  const HdMap& map = context().requireRouter().map();
  const VehicleParams& vehicle = context().params().vehicle;
  const Pose2d spot = spotOf(command);
  const Direction into = command.parking_inwards ? Direction::kForward : Direction::kReverse;
  const Pose2d before = compose(spot, {command.parking_inwards ? -straight_last_ : straight_last_, 0.0, 0.0});
  EndState straight_on;
  straight_on.direction = into;
  const Polygon& area = areaOf(command).polygon;

  const Pose2d entry = plan->path.empty() ? plan->start.pose() : plan->path.back().pose();
  const Region region = planner_->regionOf(surfaceWith(map, area, entry, cancel));
  const Path last = straightPath(before, straight_last_, into, planner_->params().spacing, vehicle);
  const CollisionChecker checker(vehicle, planner_->params().margin, region, cancel.checkpoint(), {spot, before});
  for (const ReferencePoint& point : last) {
    if (const auto collision = checker.collisionAt(point.pose())) {
      throw GoalBlocked(
          text("the straight last ", metres(straight_last_), " (~straight_last) into parking_spot_pose ", at(spot), " ",
               collision->description(), " near ", at(collision->at),
               unknownCellsHint(vehicle, planner_->params().margin, region, point.pose(), cancel.checkpoint())));
    }
  }
  if (plan->path.empty()) {
    plan->scene.start = entry;
    const EndStates ends{std::nullopt, {straight_on}};
    planner_->append(planner_->plan(entry, {before}, region, deadline, cancel, plan->scene, ends, plan->take_over),
                     plan);
    showRegion(region, &plan->scene);
  } else {
    plan->take_over();
    if (!command.is_start_pose_set) {
      leaveParkingPlace(context(), plan->start.pose(), *planner_, deadline.part(0.5), cancel, plan);
    }
    leaveRouteFor({before}, {straight_on}, region, *planner_, deadline, cancel, plan);
  }
  plan->path = join(plan->path, last, context().params().vehicle);
  const double clearance = checker.minClearance(last);
  if (clearance < planner_->params().margin - kRounding) {
    plan->report.warnings.push_back(
        text("the straight last ", metres(straight_last_), " into parking_spot_pose ", at(spot), " comes as near as ",
             metres(clearance), " to an obstacle, nearer than the margin of ", metres(planner_->params().margin)));
  }
  plan->report.min_clearance = std::min(plan->report.min_clearance, clearance);
  plan->scene.goal = spot;
  plan->command.command_type = PlanningCommand::CUSTOM;
  plan->command.custom_command = packAny(command);
}

}  // namespace external_command
