// SPDX-License-Identifier: Apache-2.0
#include "valet_parking_command_processor.h"

#include <algorithm>

#include "external_command/core/text.h"

namespace external_command {

namespace {

/// True where `point` lies on its lane somewhere along `space`.
bool isBeside(const HdMap& map, const ParkingSpace& space, const LanePoint& point) {
  double first = map.lane(point.lane).length();
  double last = 0.0;
  for (const Point2d& corner : space.polygon.points()) {
    const double s = map.lane(point.lane).center.project(corner).s;
    first = std::min(first, s);
    last = std::max(last, s);
  }
  return point.s >= first && point.s <= last;
}

/// A vehicle that stands beside the space, but a little beyond the point abreast of it, must not go round the block:
/// where a start lies beside the space on a candidate's lane, that start takes the candidate's place.
void stayBeside(const HdMap& map, const ParkingSpace& space, const std::vector<LanePoint>& starts,
                std::vector<LanePoint>* candidates) {
  for (LanePoint& candidate : *candidates) {
    const auto is_there = [&](const LanePoint& start) {
      return start.lane == candidate.lane && isBeside(map, space, start);
    };
    const auto start = std::find_if(starts.begin(), starts.end(), is_there);
    if (start != starts.end()) candidate.s = start->s;
  }
}

}  // namespace

ValetParkingCommandProcessor::ValetParkingCommandProcessor()
    : MotionCommandProcessor<ValetParking>("external_command/valet_parking") {}

ValetParkingCommandProcessor::~ValetParkingCommandProcessor() { stopServing(); }

void ValetParkingCommandProcessor::start() {
  MotionCommandProcessor<ValetParking>::start();
  planner_.emplace(getNodeHandle(), parameters(), context());
  direction_ = readParkingDirection(parameters());
}

void ValetParkingCommandProcessor::check(const ValetParkingCommand& command) const {
  if (command.parking_spot_id.empty()) {
    throw InvalidRequest("parking_spot_id is empty; give the id of a parking space of the map");
  }
  checkWayPoints(command.way_point, command.is_start_pose_set);
  checkBlackList(command.blacklisted_lane, command.blacklisted_road);
  requireNotNegative(command.target_speed, "target_speed");
}

std::optional<RoutingTask> ValetParkingCommandProcessor::convert(const ValetParkingCommand& command,
                                                                 const PlanStart& start) {
  const HdMap& map = context().requireRouter().map();
  bool used_geometry = false;
  std::vector<LanePoint> candidates =
      LaneWayTool(map, context().params().lane_way).fromParkingSpace(command.parking_spot_id, &used_geometry);

  RoutingTask task =
      beginRoutingTask(context(), start, command.header.frame_id, command.is_start_pose_set, command.way_point);
  if (task.query.via.empty()) {
    stayBeside(map, *map.findParkingSpace(command.parking_spot_id), task.query.starts, &candidates);
  }
  setGoals(map, candidates, &task);
  addBlackList(map, command.blacklisted_lane, command.blacklisted_road, &task);
  if (used_geometry) {
    task.warnings.push_back(text("the map has no lane overlap for parking space ", command.parking_spot_id,
                                 "; the lanes to park from were chosen by distance (~routing/parking_lane_radius)"));
  }
  return task;
}

void ValetParkingCommandProcessor::processSpecialCommand(const ValetParkingCommand& command, const CancelToken& cancel,
                                                         MotionPlan* plan) {
  const HdMap& map = context().requireRouter().map();
  const VehicleParams& vehicle = context().params().vehicle;
  const ParkingSpace& space = *map.findParkingSpace(command.parking_spot_id);
  if (!command.is_start_pose_set) {
    leaveParkingPlace(context(), plan->start.pose(), *planner_, cancel, plan);
  }
  const double margin = planner_->params().margin;
  const std::vector<Pose2d> goals = parkingPoses(space, vehicle, margin, direction_);
  const Polygon place = placeFor(space, vehicle, margin, goals.front());
  const Region region = planner_->regionOf(surfaceWith(map, place, plan->path.back().pose()));
  try {
    leaveRouteFor(goals, region, *planner_, cancel, plan);
  } catch (const GoalBlocked& error) {
    throw GoalBlocked(text("the vehicle does not fit into parking space ", space.id, " (non_drivable_roi are the ",
                           "neighbouring spaces): ", error.what()));
  }

  plan->command.command_type = PlanningCommand::PARKING;
  plan->command.parking_command.parking_spot_id = command.parking_spot_id;
  plan->command.parking_command.target_speed = std::min(command.target_speed, vehicle.max_speed);
}

}  // namespace external_command
