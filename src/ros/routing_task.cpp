// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/routing_task.h"

#include <optional>

#include "external_command/core/text.h"
#include "external_command/ros/conversions.h"
#include "external_command/routing/black_list.h"

namespace external_command {

namespace {

LaneWaypoint toMsg(const HdMap& map, const LanePoint& point) {
  const Lane& lane = map.lane(point.lane);
  const Pose2d pose = lane.center.poseAt(point.s);
  LaneWaypoint msg;
  msg.id = lane.id;
  msg.s = lane.statedS(point.s);
  msg.pose = toPointMsg(pose.position());
  msg.heading = pose.heading;
  msg.has_heading = true;
  return msg;
}

std::vector<LanePoint> onLanes(const ProcessContext& context, const Pose& pose, const std::string& frame_id,
                               const std::string& field) {
  const Pose2d at_map = toMapPose(pose, context.vehiclePose().ofFrame(frame_id));
  const auto heading = pose.has_heading ? std::optional<double>(at_map.heading) : std::nullopt;
  LaneHint hint;
  if (pose.has_z) hint.height = pose.z + context.vehiclePose().heightOfFrame(frame_id);
  hint.lane_id = pose.lane_id;
  return LaneWayTool(context.requireRouter().map(), context.params().lane_way)
      .fromPose(at_map.position(), heading, field, hint);
}

}  // namespace

RoutingTask beginRoutingTask(const ProcessContext& context, const PlanStart& vehicle, const std::string& frame_id,
                             bool is_start_pose_set, const std::vector<Pose>& way_points) {
  const HdMap& map = context.requireRouter().map();
  const Pose2d frame = context.vehiclePose().ofFrame(frame_id);
  RoutingTask task;
  task.request.header.frame_id = context.params().map_frame;
  task.request.header.stamp = ros::Time::now();
  task.request.is_start_pose_set = is_start_pose_set;
  if (!is_start_pose_set) {
    task.vehicle = vehicle.pose();
    task.query.starts =
        LaneWayTool(map, context.params().lane_way).fromVehicle(*task.vehicle, context.vehiclePose().height());
    task.request.waypoint.push_back(toMsg(map, task.query.starts.front()));
  }
  for (std::size_t i = 0; i < way_points.size(); ++i) {
    std::vector<LanePoint> points = onLanes(context, way_points[i], frame_id, text("way_point[", i, "]"));
    task.request.waypoint.push_back(toMsg(map, points.front()));
    if (i == 0 && is_start_pose_set) {
      task.query.starts = std::move(points);
    } else {
      task.query.via.push_back(std::move(points));
      task.way_points.push_back(toMapPose(way_points[i], frame).position());
    }
  }
  return task;
}

void addBlackList(const HdMap& map, const std::vector<LaneSegment>& lanes, const std::vector<std::string>& roads,
                  RoutingTask* task) {
  std::vector<BlackListedLane> parts;
  for (const LaneSegment& lane : lanes) parts.push_back({lane.id, lane.start_s, lane.end_s});
  task->query.black_list = blackList(map, parts, roads);
  task->request.blacklisted_lane = lanes;
  task->request.blacklisted_road = roads;
}

void setGoal(const ProcessContext& context, const std::string& frame_id, const Pose& pose, const std::string& field,
             RoutingTask* task) {
  setGoals(context.requireRouter().map(), onLanes(context, pose, frame_id, field), task);
}

void setGoals(const HdMap& map, const std::vector<LanePoint>& candidates, RoutingTask* task) {
  task->query.goals = candidates;
  task->request.waypoint.push_back(toMsg(map, candidates.front()));
}

RoutingRequest requestOf(const HdMap& map, const RoutingTask& task, const Route& route) {
  RoutingRequest request = task.request;
  std::vector<LanePoint> taken = {task.query.starts[route.start]};
  for (std::size_t i = 0; i < route.via.size(); ++i) taken.push_back(task.query.via[i][route.via[i]]);
  taken.push_back(task.query.goals[route.goal]);
  request.waypoint.clear();
  for (const LanePoint& point : taken) request.waypoint.push_back(toMsg(map, point));
  return request;
}

}  // namespace external_command
