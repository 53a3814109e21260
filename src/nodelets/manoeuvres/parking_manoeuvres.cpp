// SPDX-License-Identifier: Apache-2.0
#include "parking_manoeuvres.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "external_command/core/text.h"
#include "external_command/map/drivable_surface.h"
#include "parking_poses.h"
#include "path_joint.h"

namespace external_command {

namespace {

constexpr double kSurfaceRadius = 25.0;                     // of lanes around a place to manoeuvre [m]
constexpr double kGapRadius = 10.0;                         // along the lane, that such a gap is closed [m]
constexpr double kGaps[] = {0.3, 1.0, 2.0, 3.0, 4.0, 5.0};  // between lanes and a space, tried in turn [m]
constexpr double kThroat = 1.0;  // by which more than just touching is open between lane and space [m]
constexpr double kLeavingPoints[] = {0.0, 4.0, 8.0, 12.0};         // before the route's end, from which to leave it [m]
constexpr double kJoiningPoints[] = {5.0, 8.0, 12.0, 16.0, 22.0};  // after the route's start, where to get onto it [m]

Point2d middleOf(const Polygon& polygon) {
  Point2d sum = Point2d::Zero();
  for (const Point2d& corner : polygon.points()) sum += corner - polygon.points()[0];
  return polygon.points()[0] + sum / static_cast<double>(polygon.points().size());
}

Point2d middleOf(const VehicleParams& vehicle, const Pose2d& pose) {
  return pose.position() + (vehicle.length() / 2.0 - vehicle.rear_overhang) * unitVector(pose.heading);
}

/// The point of `path` nearest to arc length `s` [m].
std::size_t indexAt(const Path& path, double s) {
  const auto after = std::lower_bound(path.begin(), path.end(), s,
                                      [](const ReferencePoint& point, double wanted) { return point.s < wanted; });
  return after == path.end() ? path.size() - 1 : static_cast<std::size_t>(after - path.begin());
}

constexpr double kRoomAround = 0.5;  // that a vehicle is taken to have where nothing is known of the place [m]

/// What the vehicle may stand in, to be tried in turn: a parking space, an area, else the ground under it.
std::vector<Polygon> placesAt(const HdMap& map, const VehicleParams& vehicle, double margin, const Pose2d& pose) {
  const Point2d middle = middleOf(vehicle, pose);
  std::vector<Polygon> places;
  for (const ParkingSpace& space : map.parkingSpaces()) {
    if (places.empty() && space.polygon.contains(middle))
      places.push_back(ParkingSpot(space, vehicle, margin, {}).placeFor({pose}));
  }
  if (const Area* area = map.areaAt(middle)) places.push_back(area->polygon);
  if (!places.empty()) return places;
  const auto ground = footprintAt(vehicle, pose, kRoomAround);
  return {Polygon({ground.begin(), ground.end()}, "the ground under the vehicle")};
}

/// Where on the path a manoeuvre may get onto it.
std::vector<PathJoint> jointsOf(const Path& path, double bend_length) {
  std::vector<PathJoint> joints;
  for (const double after : kJoiningPoints) {
    if (after > path.back().s && !joints.empty()) break;
    joints.push_back(joiningAt(path, indexAt(path, after), bend_length));
  }
  return joints;
}

/// For a path that does not begin at the vehicle: a warning, or a refusal where that is too far away.
void tellStart(const ProcessContext& context, const Pose2d& vehicle, const std::string& why, MotionPlan* plan) {
  const Point2d begin = plan->path.front().pose().position();
  const double distance = (begin - vehicle.position()).norm(), limit = context.params().path_bounds.max_start_distance;
  const std::string what = text("the path begins on the lane at ", at(begin), ", ", metres(distance),
                                " from the vehicle: no manoeuvre leads there (", why, ")");
  if (limit > 0.0 && distance > limit) {
    throw NoPath(text(what, "; the limit is ", metres(limit), " (~routing/max_path_start_distance)"));
  }
  plan->report.warnings.push_back(what);
}

}  // namespace

Region::Parts surfaceWith(const HdMap& map, const Polygon& core, const Pose2d& on_lane, const CancelToken& cancel) {
  const auto surface_at = [&](double gap) {
    return drivableSurface(map, core, on_lane.position(), {kSurfaceRadius, gap, kGapRadius}, cancel);
  };
  const auto connects = [&](double gap) { return surface_at(gap).outer.contains(on_lane.position()); };
  const auto gap = std::find_if(std::begin(kGaps), std::prev(std::end(kGaps)), connects);
  const Surface surface = surface_at(*gap + kThroat);
  Region::Parts parts;
  parts.drivable = surface.outer;
  parts.non_drivable = surface.holes;
  for (const ParkingSpace& space : map.parkingSpaces()) {
    const Point2d middle = middleOf(space.polygon);
    const bool is_near = (middle - on_lane.position()).norm() < kSurfaceRadius;
    // A space inside the area to drive in is a mark on the ground, not a neighbour.
    if (is_near && !core.contains(middle)) parts.non_drivable.push_back(space.polygon);
  }
  return parts;
}

void leaveRouteFor(const std::vector<Pose2d>& goals, const std::vector<std::optional<EndState>>& onward,
                   const Region& region, const ManoeuvrePlanner& planner, const Deadline& deadline,
                   const CancelToken& cancel, MotionPlan* plan) {
  const double end = plan->path.back().s;
  std::size_t left = std::size(kLeavingPoints);
  std::optional<FreeSpacePlan> best;
  std::size_t best_index = 0;
  double best_cost = 0.0;
  double farthest = 0.0;
  bool ran_out_of_time = false;
  std::string why;
  for (const double before : kLeavingPoints) {
    if (before > end) break;
    const PathJoint joint = leavingAt(plan->path, indexAt(plan->path, end - before), planner.bendLength());
    const EndStates ends{joint.state, onward};
    const Deadline attempt = deadline.part(1.0 / static_cast<double>(left--));
    try {
      FreeSpacePlan found =
          planner.plan(plan->path[joint.point].pose(), goals, region, attempt, cancel, plan->scene, ends);
      const std::size_t begin = found.begins_before ? joint.bend : joint.point;
      const double cost = plan->path[begin].s + found.cost;
      if (best && cost >= best_cost) continue;
      best = std::move(found);
      best_index = begin;
      best_cost = cost;
    } catch (const Cancelled&) {
      throw;
    } catch (const GoalBlocked&) {
      throw;
    } catch (const Error& error) {
      ran_out_of_time = ran_out_of_time || error.code() == ErrorCode::kPlanningTimeout;
      if (why.empty()) why = text("no manoeuvre leads from the route to its goal: ", error.what());
      farthest = before;
    }
  }
  if (!best && farthest > 0.0) why += text("; nor does one from up to ", metres(farthest), " before the route's end");
  if (!best && ran_out_of_time) throw PlanningTimeout(why);
  if (!best) throw NoPath(why);
  plan->path.resize(best_index + 1);
  showRegion(region, &plan->scene);
  plan->scene.goal = goals[best->goal_index];
  planner.append(*best, plan);
}

void leaveParkingPlace(const ProcessContext& context, const Pose2d& vehicle, const ManoeuvrePlanner& planner,
                       const Deadline& deadline, const CancelToken& cancel, MotionPlan* plan) {
  const HdMap& map = context.requireRouter().map();
  if (!LaneWayTool(map, context.params().lane_way).isOffLane(vehicle, context.vehiclePose().height())) return;
  const double margin = planner.params().margin;
  std::string why;
  const std::vector<PathJoint> joints = jointsOf(plan->path, planner.bendLength());
  std::vector<Pose2d> poses;
  EndStates ends;
  for (const PathJoint& joint : joints) {
    poses.push_back(plan->path[joint.point].pose());
    ends.goals.push_back(joint.state);
  }
  const std::vector<Polygon> places = placesAt(map, context.params().vehicle, margin, vehicle);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Deadline attempt = deadline.part(1.0 / static_cast<double>(places.size() - i));
    try {
      const Region region = planner.regionOf(surfaceWith(map, places[i], plan->path.front().pose(), cancel));
      const FreeSpacePlan out = planner.plan(vehicle, poses, region, attempt, cancel, plan->scene, ends);
      const PathJoint& joint = joints[out.goal_index];
      const std::size_t rest_begin = out.ends_beyond ? joint.bend : joint.point;
      const Path rest(plan->path.begin() + static_cast<std::ptrdiff_t>(rest_begin), plan->path.end());
      plan->path.clear();
      planner.append(out, plan);
      plan->path = join(plan->path, rest, context.params().vehicle);
      plan->scene.start = vehicle;
      return;
    } catch (const Cancelled&) {
      throw;
    } catch (const NotReady&) {
      throw;  // of the obstacle grid, for each of the places
    } catch (const Error& error) {
      why += text(why.empty() ? "" : "; ", error.what());
    }
  }
  tellStart(context, vehicle, why, plan);
}

}  // namespace external_command
