// SPDX-License-Identifier: Apache-2.0
#include "routing_request_converter.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/text.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/conversions.h"

namespace external_command {

namespace {

bool isZero(const geometry_msgs::Point& point) { return point.x == 0.0 && point.y == 0.0; }

/// Index of the first way point that is passed on, before the last.
std::size_t firstOf(const RoutingRequest& request) {
  return request.is_start_pose_set || request.waypoint.size() < 2 ? 0 : 1;
}

Pose toMsg(const Pose2d& pose) {
  Pose msg;
  msg.x = pose.x;
  msg.y = pose.y;
  msg.heading = pose.heading;
  msg.has_heading = true;
  return msg;
}

/// On a lane of both directions the one that `heading` [rad] fits better.
LanePoint drivenAs(const HdMap& map, const LanePoint& point, double heading) {
  const Lane& lane = map.lane(point.lane);
  const bool runs_back = std::abs(angleBetween(lane.center.headingAt(point.s), heading)) > M_PI / 2.0;
  return lane.reverse && runs_back ? LanePoint{*lane.reverse, lane.length() - point.s} : point;
}

template <class Command>
void carryOver(const RoutingRequest& request, const std::string& map_frame, Command* command) {
  command->header.stamp = request.header.stamp;
  command->header.frame_id = map_frame;
  command->is_start_pose_set = request.is_start_pose_set;
  command->blacklisted_lane = request.blacklisted_lane;
  command->blacklisted_road = request.blacklisted_road;
}

}  // namespace

bool hasParkingInfo(const RoutingRequest& request) {
  const ParkingInfo& parking = request.parking_info;
  return !parking.parking_space_id.empty() || !isZero(parking.parking_point) || !parking.corner_point.points.empty();
}

LaneFollowCommand RoutingRequestConverter::toLaneFollow(const RoutingRequest& request) const {
  const std::size_t count = request.waypoint.size();
  requireSize(count, request.is_start_pose_set ? 2 : 1, context_->params().requests.max_way_points + 1, "waypoint",
              "max_way_points");
  LaneFollowCommand command;
  carryOver(request, context_->params().map_frame, &command);
  command.way_point = toPoses(request, firstOf(request), count - 1);
  command.end_pose = toPoses(request, count - 1, count).front();
  return command;
}

ValetParkingCommand RoutingRequestConverter::toValetParking(const RoutingRequest& request) const {
  const std::size_t count = request.waypoint.size();
  requireSize(count, request.is_start_pose_set ? 1 : 0, context_->params().requests.max_way_points + 1, "waypoint",
              "max_way_points");
  if (request.parking_info.parking_space_id.empty()) {
    throw InvalidRequest("parking_info has no parking_space_id; give the id of a parking space of the map");
  }
  ValetParkingCommand command;
  carryOver(request, context_->params().map_frame, &command);
  command.parking_spot_id = request.parking_info.parking_space_id;
  const std::size_t end = count == 1 && request.is_start_pose_set ? 1 : std::max<std::size_t>(count, 1) - 1;
  command.way_point = toPoses(request, firstOf(request), end);
  return command;
}

std::vector<Pose> RoutingRequestConverter::toPoses(const RoutingRequest& request, std::size_t begin,
                                                   std::size_t end) const {
  const VehiclePose& frames = context_->vehiclePose();
  const GivenFrame frame{frames.ofFrame(request.header.frame_id), frames.heightOfFrame(request.header.frame_id)};
  std::vector<Pose> poses;
  for (std::size_t i = begin; i < end; ++i) {
    poses.push_back(toPose(request.waypoint[i], frame, text("waypoint[", i, "]")));
  }
  return poses;
}

Pose RoutingRequestConverter::toPose(const LaneWaypoint& way_point, const GivenFrame& frame,
                                     const std::string& name) const {
  requireFinite(way_point.pose, name + ".pose");
  requireFinite(way_point.s, name + ".s");
  if (way_point.has_heading) requireFinite(way_point.heading, name + ".heading");
  if (!way_point.id.empty()) return onLane(way_point, frame.pose, name);
  if (isZero(way_point.pose) && !way_point.has_heading) {
    throw InvalidRequest(name + " has neither an id of a lane nor a pose (for the pose (0, 0) give a heading too)");
  }
  Pose given;
  given.x = way_point.pose.x;
  given.y = way_point.pose.y;
  given.heading = way_point.heading;
  given.has_heading = way_point.has_heading;
  Pose pose = toMsg(toMapPose(given, frame.pose));
  pose.has_heading = given.has_heading;
  pose.has_z = way_point.pose.z != 0.0 && std::isfinite(way_point.pose.z);  // who plans in the plane says 0
  if (pose.has_z) pose.z = way_point.pose.z + frame.z;
  return pose;
}

Pose RoutingRequestConverter::onLane(const LaneWaypoint& way_point, const Pose2d& frame,
                                     const std::string& name) const {
  const HdMap& map = context_->requireRouter().map();
  const LaneWayParams& params = context_->params().lane_way;
  LanePoint point = lanePoint(way_point, frame, name);
  if (way_point.has_heading) point = drivenAs(map, point, way_point.heading + frame.heading);
  const Lane& lane = map.lane(point.lane);
  Pose2d pose = lane.center.poseAt(point.s);
  const double turn = way_point.has_heading ? angleBetween(pose.heading, way_point.heading + frame.heading) : 0.0;
  if (std::abs(turn) > params.snap_heading) {
    throw InvalidRequest(text(name, ": its heading differs by ", radians(turn), " from that of its lane ", lane.id,
                              " at s ", metres(point.s), ", ", radians(pose.heading), "; the limit is ",
                              radians(params.snap_heading), " (~routing/snap_heading)"));
  }
  pose.heading = normalizeAngle(pose.heading + turn);
  Pose on_lane = toMsg(pose);
  on_lane.has_heading = way_point.has_heading;  // without one, a lane of both directions may be driven in either
  on_lane.lane_id = lane.id;
  const auto height = lane.heightAt(point.s);
  on_lane.has_z = height.has_value();  // the lane may pass above itself
  on_lane.z = height.value_or(0.0);
  return on_lane;
}

LanePoint RoutingRequestConverter::lanePoint(const LaneWaypoint& way_point, const Pose2d& frame,
                                             const std::string& name) const {
  const HdMap& map = context_->requireRouter().map();
  LanePoint point = LaneWayTool(map, context_->params().lane_way).fromLane(way_point.id, way_point.s, name);
  if (isZero(way_point.pose)) return point;

  const Lane& lane = map.lane(point.lane);
  const Point2d position = toMapPoint(way_point.pose, frame);
  if (way_point.s == 0.0) point.s = lane.center.project(position).s;  // not given
  const Point2d on_lane = lane.center.pointAt(point.s);
  const double distance = (on_lane - position).norm();
  if (distance <= tolerance_) return point;
  throw InvalidRequest(text(name, ": its pose ", at(position), " is ", metres(distance), " from its lane ", lane.id,
                            " at s ", metres(point.s), ", which is ", at(on_lane), "; the limit is ",
                            metres(tolerance_), " (~way_point_tolerance)"));
}

}  // namespace external_command
