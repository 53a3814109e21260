// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/markers.h"

#include <cmath>
#include <utility>

#include "marker_shapes.h"

namespace external_command {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kRouteArrow = 6.0;      // seen from high above [m]
constexpr double kManoeuvreArrow = 2.0;  // smaller than the footprint it stands in [m]
constexpr double kFootprintStep = 1.0;   // between two footprints drawn [m]
constexpr int kRingCorners = 48;
constexpr double kStraightPath = 0.01;  // a path is drawn straight where it turns by less [rad] ...
constexpr double kLongestLine = 10.0;   // ... and no longer than this [m]: then it is a few centimetres off

std::vector<Point2d> outline(const VehicleParams& vehicle, const Pose2d& pose) {
  const auto corners = footprintAt(vehicle, pose, 0.0);
  return {corners.begin(), corners.end()};
}

/// A line that is drawn straight from one point of a path to another hides nothing.
bool isStraight(const ReferencePoint& from, const ReferencePoint& to) {
  return std::abs(angleBetween(from.heading, to.heading)) < kStraightPath && to.s - from.s < kLongestLine;
}

void addPath(const Path& path, Marker* lines) {
  for (std::size_t from = 0, to = 1; to < path.size(); from = to++) {
    const Direction direction = path[to].direction;
    while (to + 1 < path.size() && path[to + 1].direction == direction && isStraight(path[from], path[to + 1])) ++to;
    addLine({path[from].pose().position(), path[to].pose().position()}, kPathHeight, lines);
    lines->colors.resize(lines->points.size(), direction == Direction::kForward ? paint::kForward : paint::kReverse);
  }
}

void addFootprints(const Path& path, const VehicleParams& vehicle, Marker* lines) {
  double next = 0.0;
  for (const ReferencePoint& point : path) {
    if (point.s < next && &point != &path.back()) continue;
    addRing(outline(vehicle, point.pose()), kPathHeight, lines);
    next = point.s + kFootprintStep;
  }
}

/// An arrow at `pose`, or a marker that deletes the one of an earlier command.
Marker arrow(const std::string& frame, const std::string& ns, const std::optional<Pose2d>& pose, double length,
             const std_msgs::ColorRGBA& paint) {
  Marker made = marker(frame, ns, Marker::ARROW, length, paint);
  made.scale.y = made.scale.z = length / 4.0;
  if (!pose) {
    made.action = Marker::DELETE;
    return made;
  }
  made.pose.position = raised(pose->position(), kPoseHeight);
  made.pose.orientation = rotation(pose->heading);
  return made;
}

void addRings(const std::vector<std::vector<Point2d>>& rings, Marker* lines) {
  for (const auto& ring : rings) addRing(ring, kRouteHeight, lines);
}

}  // namespace

MarkerArray vehicleMarkers(const VehicleParams& vehicle, const std::string& base_frame, double ring_radius) {
  Marker body = marker(base_frame, "footprint", Marker::CUBE, vehicle.length(), paint::kVehicle);
  body.scale.y = vehicle.width;
  body.scale.z = 0.2;
  body.pose.position.x = vehicle.length() / 2.0 - vehicle.rear_overhang;
  body.pose.position.z = kPoseHeight;

  Marker ring = marker(base_frame, "vehicle_ring", Marker::TRIANGLE_LIST, 1.0, paint::kVehicle);
  ring.pose.position = body.pose.position;
  const auto corner = [&](int i, double share) -> Point2d {
    return share * ring_radius * unitVector(2.0 * M_PI * i / kRingCorners);
  };
  for (int i = 0; i < kRingCorners; ++i) {
    const Point2d inner = corner(i, 0.9), outer = corner(i, 1.0), next_inner = corner(i + 1, 0.9);
    addTriangles({inner, outer, next_inner, outer, corner(i + 1, 1.0), next_inner}, 0.0, &ring);
  }
  addTriangles({ring_radius * Point2d(1.1, 0.4), ring_radius * Point2d(1.1, -0.4), ring_radius * Point2d(1.7, 0.0)},
               0.0, &ring);

  MarkerArray array;
  array.markers = {body, ring};
  for (Marker& part : array.markers) part.frame_locked = true;
  return array;
}

MarkerArray commandMarkers(const CommandScene& scene, const HdMap* map, const VehicleParams& vehicle,
                           const std::string& frame) {
  Marker route = marker(frame, "route", Marker::LINE_LIST, 2.5, paint::kRoute);
  if (scene.route && map != nullptr) {
    for (const RouteStep& step : scene.route->steps) {
      if (step.to_s - step.from_s < 0.01) continue;
      addLine(map->lane(step.lane).center.slice(step.from_s, step.to_s).points(), kRouteHeight, &route);
    }
  }
  Marker path = marker(frame, "path", Marker::LINE_LIST, 0.6, paint::kForward);
  if (scene.path) addPath(*scene.path, &path);
  Marker footprints = marker(frame, "footprints", Marker::LINE_LIST, 0.04, paint::kFootprint);
  if (scene.path && scene.with_footprints) addFootprints(*scene.path, vehicle, &footprints);
  Marker way_points = marker(frame, "way_points", Marker::SPHERE_LIST, 2.5, paint::kWayPoint);
  for (const Point2d& point : scene.way_points) way_points.points.push_back(raised(point, kPoseHeight));
  Marker regions = marker(frame, "region", Marker::LINE_LIST, 0.15, paint::kArea);
  addRings(scene.regions, &regions);
  Marker obstacles = marker(frame, "obstacles", Marker::LINE_LIST, 0.15, paint::kObstacle);
  addRings(scene.obstacles, &obstacles);
  Marker conflicts = marker(frame, "conflicts", Marker::LINE_LIST, 0.3, paint::kConflict);
  addRings(scene.conflicts, &conflicts);

  MarkerArray array;
  for (Marker* part : {&route, &path, &footprints, &way_points, &regions, &obstacles, &conflicts}) {
    if (part->points.empty()) part->action = Marker::DELETE;
    array.markers.push_back(std::move(*part));
  }
  const double arrow_length = scene.with_footprints ? kManoeuvreArrow : kRouteArrow;
  array.markers.push_back(arrow(frame, "start", scene.start, arrow_length, paint::kForward));
  array.markers.push_back(arrow(frame, "goal", scene.goal, arrow_length, paint::kConflict));
  return array;
}

}  // namespace external_command
