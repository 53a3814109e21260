// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/conversions.h"

#include "external_command/core/obstacle_polygon.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

std::uint8_t changeTypeOf(LaneChange change) {
  switch (change) {
    case LaneChange::kLeft:
      return Passage::LEFT;
    case LaneChange::kRight:
      return Passage::RIGHT;
    case LaneChange::kNone:
      break;
  }
  return Passage::FORWARD;
}

Passage toPassage(const HdMap& map, const RoutePassage& passage) {
  Passage msg;
  msg.can_exit = passage.can_exit;
  msg.change_lane_type = changeTypeOf(passage.change);
  msg.segment.resize(passage.lanes.size());
  for (std::size_t i = 0; i < passage.lanes.size(); ++i) {
    const Lane& lane = map.lane(passage.lanes[i].lane);
    msg.segment[i].id = lane.id;
    msg.segment[i].start_s = lane.statedS(passage.lanes[i].from_s);
    msg.segment[i].end_s = lane.statedS(passage.lanes[i].to_s);
  }
  return msg;
}

}  // namespace

Pose2d toMapPose(const Pose& pose, const Pose2d& frame) {
  return compose(frame, {pose.x, pose.y, pose.has_heading ? pose.heading : 0.0});
}

Point2d toMapPoint(const geometry_msgs::Point& point, const Pose2d& frame) {
  return compose(frame, {point.x, point.y, 0.0}).position();
}

std::vector<Point2d> toMapPoints(const std::vector<geometry_msgs::Point>& points, const Pose2d& frame) {
  std::vector<Point2d> converted;
  converted.reserve(points.size());
  for (const auto& point : points) converted.push_back(toMapPoint(point, frame));
  return converted;
}

Polygon toPolygon(const RoiPolygon& roi, const Pose2d& frame, const std::string& name) {
  return Polygon(toMapPoints(roi.points, frame), name);
}

std::vector<Polygon> toObstacles(const std::vector<RoiPolygon>& non_drivable_roi, const Pose2d& frame,
                                 const CancelToken& cancel) {
  std::vector<Polygon> obstacles;
  for (const RoiPolygon& roi : non_drivable_roi) {
    cancel.throwIfCancelled();
    obstacles.push_back(
        obstaclePolygon(toMapPoints(roi.points, frame), text("non_drivable_roi[", obstacles.size(), "]")));
  }
  return obstacles;
}

geometry_msgs::Point toPointMsg(const Point2d& point) {
  geometry_msgs::Point msg;
  msg.x = point.x();
  msg.y = point.y();
  return msg;
}

PlannedPath toMsg(const Path& path) {
  PlannedPath msg;
  msg.points.resize(path.size());
  bool uses_tool = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const ReferencePoint& from = path[i];
    auto& to = msg.points[i];
    to.x = from.x;
    to.y = from.y;
    to.heading = from.heading;
    to.kappa = from.kappa;
    to.s = from.s;
    to.speed = from.speed;
    to.direction = static_cast<std::int8_t>(from.direction);
    uses_tool = uses_tool || from.tool_on;
  }
  if (!uses_tool) return msg;
  for (const ReferencePoint& point : path) msg.tool_on.push_back(point.tool_on);
  return msg;
}

RoutingResponse toRoutingResponse(const HdMap& map, const Route& route) {
  RoutingResponse response;
  response.distance = route.distance;
  const std::vector<RouteSegment> segments = toSegments(map, route);
  response.road.resize(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    response.road[i].id = segments[i].id;
    for (const RoutePassage& passage : segments[i].passages)
      response.road[i].passage.push_back(toPassage(map, passage));
  }
  return response;
}

}  // namespace external_command
