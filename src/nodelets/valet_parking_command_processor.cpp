// SPDX-License-Identifier: Apache-2.0
#include "valet_parking_command_processor.h"

#include <ros/console.h>

#include <algorithm>

#include "external_command/ValetParkingAction.h"
#include "external_command/core/text.h"
#include "external_command/ros/action_front.h"

namespace external_command {

namespace {

constexpr double kMaxGapToLane = 5.0;      // between a space and the edge of a lane to park from [m]
constexpr std::size_t kMaxOtherLanes = 3;  // tried after the one that the map names
constexpr double kFirstShare = 0.6;        // of the time, for that one
constexpr double kSamePlace = 1e-3;        // [m] or [rad]

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

/// Around a place, for obstacles that are farther away not to be taken in.
Polygon surroundingsOf(const Polygon& place) {
  constexpr double kRoom = 2.0;  // [m]
  const Point2d low = place.box().min - Point2d(kRoom, kRoom), high = place.box().max + Point2d(kRoom, kRoom);
  return Polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, "the surroundings of the parking space");
}

bool mayHelpElsewhere(ErrorCode code) {
  return code == ErrorCode::kNoPath || code == ErrorCode::kPlanningTimeout || code == ErrorCode::kNoRoute;
}

}  // namespace

ValetParkingCommandProcessor::ValetParkingCommandProcessor()
    : MotionCommandProcessor<ValetParking>("external_command/valet_parking") {
  offerAction<ValetParkingAction>();
}

ValetParkingCommandProcessor::~ValetParkingCommandProcessor() { stopServing(); }

void ValetParkingCommandProcessor::start() {
  MotionCommandProcessor<ValetParking>::start();
  planner_.emplace(getNodeHandle(), parameters(), context());
  needsMap();
  needsPose();
  if (planner_->hasGrid()) needs("obstacle_grid", [this] { return planner_->gridWords(); });
  params_ = readParkingParams(parameters());
  reportSmallSpaces();
}

void ValetParkingCommandProcessor::reportSmallSpaces() const {
  if (context().router() == nullptr) return;
  std::size_t small = 0, too_small = 0;
  const ParkingSpace* worst = nullptr;
  double least_area = 0.0;
  for (const ParkingSpace& space : context().router()->map().parkingSpaces()) {
    const ParkingSpot spot = spotIn(space);
    if (!spot.isSmall()) continue;
    ++small;
    if (!spot.shortage().empty()) ++too_small;
    if (worst != nullptr && spot.length() * spot.width() >= least_area) continue;
    worst = &space;
    least_area = spot.length() * spot.width();
  }
  if (worst == nullptr) return;
  const VehicleParams& vehicle = context().params().vehicle;
  ROS_WARN_STREAM(small << " of " << context().router()->map().parkingSpaces().size()
                        << " parking spaces are smaller than the vehicle, " << metres(vehicle.length()) << " x "
                        << metres(vehicle.width) << " (~vehicle), and " << too_small
                        << " too small to park in; the smallest is " << worst->id << ", "
                        << metres(spotIn(*worst).length()) << " x " << metres(spotIn(*worst).width()));
}

void ValetParkingCommandProcessor::check(const ValetParkingCommand& command) const {
  if (command.parking_spot_id.empty()) {
    throw InvalidRequest("parking_spot_id is empty; give the id of a parking space of the map");
  }
  checkWayPoints(command.way_point, command.is_start_pose_set, context().params().requests);
  checkBlackList(command.blacklisted_lane, command.blacklisted_road, context().params().requests);
  requireTargetSpeed(command.target_speed);
}

ParkingSpot ValetParkingCommandProcessor::spotIn(const ParkingSpace& space) const {
  return {space, context().params().vehicle, planner_->params().margin, params_};
}

/// @pre  the map has it.
const ParkingSpace& ValetParkingCommandProcessor::spaceOf(const ValetParkingCommand& command) const {
  return *context().requireRouter().map().findParkingSpace(command.parking_spot_id);
}

RoutingTask ValetParkingCommandProcessor::taskTo(const ValetParkingCommand& command, const PlanStart& start,
                                                 std::vector<LanePoint> candidates) const {
  const HdMap& map = context().requireRouter().map();
  RoutingTask task =
      beginRoutingTask(context(), start, command.header.frame_id, command.is_start_pose_set, command.way_point);
  if (task.query.via.empty()) stayBeside(map, spaceOf(command), task.query.starts, &candidates);
  setGoals(map, candidates, &task);
  addBlackList(map, command.blacklisted_lane, command.blacklisted_road, &task);
  return task;
}

/// The lanes alongside the space but for those of `known`.
std::vector<LanePoint> ValetParkingCommandProcessor::otherLanes(const ParkingSpace& space,
                                                                const std::vector<LanePoint>& known) const {
  const HdMap& map = context().requireRouter().map();
  std::vector<LanePoint> lanes = LaneWayTool(map, context().params().lane_way).alongParkingSpace(space, kMaxGapToLane);
  const auto is_known = [&](const LanePoint& point) {
    return std::any_of(known.begin(), known.end(), [&](const LanePoint& other) { return other.lane == point.lane; });
  };
  lanes.erase(std::remove_if(lanes.begin(), lanes.end(), is_known), lanes.end());
  return lanes;
}

bool ValetParkingCommandProcessor::findRoute(RoutingTask* task) const {
  try {
    task->route = context().requireRouter().findRoute(task->query, CancelToken());
    return true;
  } catch (const NoRoute&) {
    return false;
  }
}

std::optional<RoutingTask> ValetParkingCommandProcessor::convert(const ValetParkingCommand& command,
                                                                 const PlanStart& start) {
  const HdMap& map = context().requireRouter().map();
  bool used_geometry = false;
  const std::vector<LanePoint> candidates =
      LaneWayTool(map, context().params().lane_way).fromParkingSpace(command.parking_spot_id, &used_geometry);
  const ParkingSpace& space = spaceOf(command);
  const std::string shortage = spotIn(space).shortage();
  if (!shortage.empty()) {
    throw GoalBlocked(text("parking space ", space.id, " is too small for the vehicle: ", shortage));
  }
  RoutingTask task = taskTo(command, start, candidates);
  if (used_geometry) {
    task.warnings.push_back(text("the map has no lane overlap for parking space ", command.parking_spot_id,
                                 "; the lanes to park from were chosen by distance (~routing/parking_lane_radius)"));
  } else if (!findRoute(&task)) {
    const std::vector<LanePoint> others = otherLanes(space, candidates);
    if (others.empty()) return task;
    RoutingTask other = taskTo(command, start, others);
    if (!findRoute(&other)) return task;
    other.warnings.push_back(text("no route leads to lane ", map.lane(candidates.front().lane).id,
                                  ", which the map names for parking space ", space.id,
                                  "; the vehicle parks from a lane alongside"));
    return other;
  }
  return task;
}

void ValetParkingCommandProcessor::processSpecialCommand(const ValetParkingCommand& command, const CancelToken& cancel,
                                                         MotionPlan* plan) {
  const Deadline deadline = planner_->deadline();
  const MotionPlan routed = *plan;
  const bool has_others = !otherLanes(spaceOf(command), {{plan->route->steps.back().lane, 0.0}}).empty();
  try {
    park(command, has_others ? deadline.part(kFirstShare) : deadline, cancel, plan);
  } catch (const Error& error) {
    if (!mayHelpElsewhere(error.code())) throw;
    *plan = routed;
    if (!parkFromOtherLane(command, error.what(), deadline, cancel, plan)) throw;
  }
  plan->command.command_type = PlanningCommand::PARKING;
  plan->command.parking_command.parking_spot_id = command.parking_spot_id;
  plan->command.parking_command.target_speed = std::min(command.target_speed, context().params().vehicle.max_speed);
}

std::vector<Pose2d> ValetParkingCommandProcessor::freePosesIn(const ParkingSpace& space, const MotionPlan& plan,
                                                              const CancelToken& cancel) const {
  const HdMap& map = context().requireRouter().map();
  const ParkingSpot spot = spotIn(space);
  const Polygon place = spot.placeFor(spot.poses());
  Region::Parts parts = surfaceWith(map, place, plan.path.back().pose(), cancel);
  parts.drivable = surroundingsOf(place);
  const Region obstacles = planner_->regionOf(std::move(parts));
  const CollisionChecker checker(context().params().vehicle, planner_->params().margin, obstacles, cancel.checkpoint());
  std::vector<Pose2d> poses = spot.freePoses(checker);
  if (!poses.empty()) return poses;
  planner_->showConflicts(spot.poses(), obstacles, plan.scene, cancel);
  const auto collision = checker.collisionAt(spot.poses().front());
  throw GoalBlocked(
      text("the vehicle does not fit into parking space ", space.id, ": in its middle it ",
           collision ? text(collision->description(), " near ", at(collision->at)) : "overlaps an obstacle",
           ", the margin of ", metres(planner_->params().margin), " (~free_space/margin) included",
           unknownCellsHint(context().params().vehicle, planner_->params().margin, obstacles, spot.poses().front(),
                            cancel.checkpoint()),
           ", and nowhere within ", metres(params_.position_tolerance), " and ", radians(params_.heading_tolerance),
           " of it is there room (~parking_position_tolerance, ~parking_heading_tolerance)"));
}

void ValetParkingCommandProcessor::park(const ValetParkingCommand& command, const Deadline& deadline,
                                        const CancelToken& cancel, MotionPlan* plan) const {
  const HdMap& map = context().requireRouter().map();
  const ParkingSpace& space = spaceOf(command);
  const ParkingSpot spot = spotIn(space);
  const std::vector<Pose2d> goals = freePosesIn(space, *plan, cancel);
  plan->take_over();
  if (!command.is_start_pose_set) {
    leaveParkingPlace(context(), plan->start.pose(), *planner_, deadline.part(0.5), cancel, plan);
  }
  const Region region = planner_->regionOf(surfaceWith(map, spot.placeFor(goals), plan->path.back().pose(), cancel));
  try {
    leaveRouteFor(goals, {}, region, *planner_, deadline, cancel, plan);
  } catch (const GoalBlocked& error) {
    throw GoalBlocked(text("the vehicle does not fit into parking space ", space.id, ": ", error.what()));
  }
  const Pose2d offset = spot.offsetOf(plan->path.back().pose());
  if (offset.position().norm() < kSamePlace && std::abs(offset.heading) < kSamePlace) return;
  plan->report.warnings.push_back(text("the middle of parking space ", space.id, " is blocked; the vehicle stands ",
                                       metres(offset.position().norm()), " and ", radians(std::abs(offset.heading)),
                                       " off it (~parking_position_tolerance, ~parking_heading_tolerance)"));
}

bool ValetParkingCommandProcessor::parkFromOtherLane(const ValetParkingCommand& command, const std::string& why,
                                                     const Deadline& deadline, const CancelToken& cancel,
                                                     MotionPlan* plan) const {
  const HdMap& map = context().requireRouter().map();
  const LanePoint taken{plan->route->steps.back().lane, 0.0};
  std::vector<LanePoint> others = otherLanes(spaceOf(command), {taken});
  if (others.size() > kMaxOtherLanes) others.resize(kMaxOtherLanes);
  for (std::size_t i = 0; i < others.size() && !deadline.hasPassed(); ++i) {
    MotionPlan other = *plan;
    other.report = PlanReport();
    const double speed = flow().cappedSpeed(command.target_speed, &other.report);
    try {
      flow().addRoute(taskTo(command, plan->start, {others[i]}), speed, cancel, &other);
      park(command, deadline.part(1.0 / static_cast<double>(others.size() - i)), cancel, &other);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error&) {
      continue;
    }
    other.report.warnings.push_back(text("the vehicle parks from lane ", map.lane(others[i].lane).id, ", not from ",
                                         map.lane(taken.lane).id, ": ", why));
    *plan = std::move(other);
    return true;
  }
  return false;
}

}  // namespace external_command
