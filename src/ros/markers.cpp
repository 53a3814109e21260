// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/markers.h"

#include <cmath>
#include <utility>

namespace external_command {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

// One above the other, so that what matters more is not hidden [m].
constexpr double kSurfaceHeight = -0.2;
constexpr double kLineHeight = 0.0;
constexpr double kRouteHeight = 0.2;
constexpr double kPathHeight = 0.4;
constexpr double kPoseHeight = 0.6;
constexpr double kRouteArrow = 6.0;       // seen from high above [m]
constexpr double kManoeuvreArrow = 2.0;   // smaller than the footprint it stands in [m]
constexpr double kFootprintStep = 1.0;    // between two footprints drawn [m]
constexpr double kStraightEnough = 0.02;  // a line's points that turn less than this are left out [rad]
constexpr double kLongestSegment = 25.0;  // [m]

std_msgs::ColorRGBA color(float r, float g, float b, float a = 1.0F) {
  std_msgs::ColorRGBA made;
  made.r = r;
  made.g = g;
  made.b = b;
  made.a = a;
  return made;
}

const auto kWhite = color(0.85F, 0.85F, 0.85F);
const auto kYellow = color(0.95F, 0.75F, 0.1F);
const auto kForward = color(0.1F, 0.9F, 0.3F);
const auto kReverse = color(1.0F, 0.45F, 0.0F);
const auto kRed = color(0.95F, 0.1F, 0.1F);

geometry_msgs::Point raised(const Point2d& point, double height) {
  geometry_msgs::Point msg;
  msg.x = point.x();
  msg.y = point.y();
  msg.z = height;
  return msg;
}

geometry_msgs::Quaternion rotation(double heading) {
  geometry_msgs::Quaternion msg;
  msg.z = std::sin(heading / 2.0);
  msg.w = std::cos(heading / 2.0);
  return msg;
}

Marker marker(const std::string& frame, const std::string& ns, int type, double scale,
              const std_msgs::ColorRGBA& paint) {
  Marker made;
  made.header.frame_id = frame;
  made.ns = ns;
  made.type = type;
  made.action = Marker::ADD;
  made.pose.orientation.w = 1.0;
  made.scale.x = scale;
  if (type == Marker::SPHERE_LIST || type == Marker::TRIANGLE_LIST) made.scale.y = made.scale.z = scale;
  made.color = paint;
  return made;
}

void addLine(const std::vector<Point2d>& points, double height, Marker* lines) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    lines->points.push_back(raised(points[i], height));
    lines->points.push_back(raised(points[i + 1], height));
  }
}

void addRing(std::vector<Point2d> points, double height, Marker* lines) {
  if (points.empty()) return;
  points.push_back(points.front());
  addLine(points, height, lines);
}

/// Which points of a dense line are needed to draw it.
std::vector<std::size_t> drawnPoints(const std::vector<Point2d>& points) {
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point2d in = points[i] - points[kept.back()], out = points[i + 1] - points[i];
    const double turn = std::abs(angleBetween(headingOf(in), headingOf(out)));
    if (turn > kStraightEnough || in.norm() > kLongestSegment) kept.push_back(i);
  }
  if (points.size() > 1) kept.push_back(points.size() - 1);
  return kept;
}

void addSurface(const Lane& lane, Marker* triangles) {
  const auto& points = lane.center.points();
  const auto headings = headingsOf(points);
  geometry_msgs::Point last_left, last_right;
  bool first = true;
  for (const std::size_t i : drawnPoints(points)) {
    const double half = lane.widthAt(lane.center.arcLengths()[i]) / 2.0;
    const Point2d side = half * unitVector(headings[i] + M_PI / 2.0);
    const auto left = raised(points[i] + side, kSurfaceHeight), right = raised(points[i] - side, kSurfaceHeight);
    if (!first) {
      for (const auto& corner : {last_left, last_right, left, left, last_right, right}) {
        triangles->points.push_back(corner);
      }
    }
    last_left = left;
    last_right = right;
    first = false;
  }
}

void addBoundary(const LaneBoundary& boundary, Marker* lines) {
  if (boundary.is_virtual || boundary.points.size() < 2) return;
  const BoundaryType type = boundary.types.empty() ? BoundaryType::kUnknown : boundary.types.front().type;
  const bool is_yellow =
      type == BoundaryType::kDottedYellow || type == BoundaryType::kSolidYellow || type == BoundaryType::kDoubleYellow;
  std::vector<Point2d> points;
  for (const std::size_t i : drawnPoints(boundary.points)) points.push_back(boundary.points[i]);
  addLine(points, kLineHeight, lines);
  lines->colors.resize(lines->points.size(), is_yellow ? kYellow : kWhite);
}

std::vector<Point2d> outline(const VehicleParams& vehicle, const Pose2d& pose) {
  const auto corners = footprintAt(vehicle, pose, 0.0);
  return {corners.begin(), corners.end()};
}

void addPath(const Path& path, Marker* lines) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    lines->points.push_back(raised(path[i - 1].pose().position(), kPathHeight));
    lines->points.push_back(raised(path[i].pose().position(), kPathHeight));
    lines->colors.resize(lines->points.size(), path[i].direction == Direction::kForward ? kForward : kReverse);
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

MarkerArray mapMarkers(const HdMap& map, const std::string& frame) {
  Marker surfaces = marker(frame, "lanes", Marker::TRIANGLE_LIST, 1.0, color(0.30F, 0.31F, 0.34F));
  Marker others = marker(frame, "other_lanes", Marker::TRIANGLE_LIST, 1.0, color(0.22F, 0.22F, 0.23F));
  Marker centers = marker(frame, "center_lines", Marker::LINE_LIST, 0.08, color(0.45F, 0.5F, 0.6F));
  Marker boundaries = marker(frame, "boundaries", Marker::LINE_LIST, 0.15, kWhite);
  Marker junctions = marker(frame, "junctions", Marker::LINE_LIST, 0.2, color(0.5F, 0.4F, 0.7F));
  Marker spaces = marker(frame, "parking_spaces", Marker::LINE_LIST, 0.15, color(0.3F, 0.7F, 1.0F));
  Marker areas = marker(frame, "areas", Marker::LINE_LIST, 0.3, color(0.3F, 0.8F, 0.7F));
  for (const Lane& lane : map.lanes()) {
    addSurface(lane, lane.isDrivable() ? &surfaces : &others);
    if (lane.isDrivable()) {
      std::vector<Point2d> center;
      for (const std::size_t i : drawnPoints(lane.center.points())) center.push_back(lane.center.points()[i]);
      addLine(center, kLineHeight, &centers);
    }
    addBoundary(lane.left, &boundaries);
    addBoundary(lane.right, &boundaries);
  }
  for (const Junction& junction : map.junctions()) addRing(junction.polygon.points(), kLineHeight, &junctions);
  for (const ParkingSpace& space : map.parkingSpaces()) addRing(space.polygon.points(), kLineHeight, &spaces);
  for (const Area& area : map.areas()) addRing(area.polygon.points(), kLineHeight, &areas);

  MarkerArray array;
  for (Marker* part : {&surfaces, &others, &centers, &boundaries, &junctions, &spaces, &areas}) {
    if (!part->points.empty()) array.markers.push_back(std::move(*part));
  }
  return array;
}

Marker vehicleMarker(const VehicleParams& vehicle, const std::string& base_frame) {
  Marker body = marker(base_frame, "footprint", Marker::CUBE, vehicle.length(), color(1.0F, 0.6F, 0.1F));
  body.scale.y = vehicle.width;
  body.scale.z = 0.2;
  body.pose.position.x = vehicle.length() / 2.0 - vehicle.rear_overhang;
  body.pose.position.z = kPoseHeight;
  body.frame_locked = true;
  return body;
}

MarkerArray commandMarkers(const CommandScene& scene, const HdMap* map, const VehicleParams& vehicle,
                           const std::string& frame) {
  Marker route = marker(frame, "route", Marker::LINE_LIST, 2.5, color(0.15F, 0.45F, 0.95F, 0.6F));
  if (scene.route && map != nullptr) {
    for (const RouteStep& step : scene.route->steps) {
      if (step.to_s - step.from_s < 0.01) continue;
      addLine(map->lane(step.lane).center.slice(step.from_s, step.to_s).points(), kRouteHeight, &route);
    }
  }
  Marker path = marker(frame, "path", Marker::LINE_LIST, 0.6, kForward);
  addPath(scene.path, &path);
  Marker footprints = marker(frame, "footprints", Marker::LINE_LIST, 0.04, color(0.8F, 0.8F, 0.4F, 0.6F));
  if (scene.with_footprints) addFootprints(scene.path, vehicle, &footprints);
  Marker way_points = marker(frame, "way_points", Marker::SPHERE_LIST, 2.5, color(0.9F, 0.3F, 0.9F));
  for (const Point2d& point : scene.way_points) way_points.points.push_back(raised(point, kPoseHeight));
  Marker regions = marker(frame, "region", Marker::LINE_LIST, 0.15, color(0.3F, 0.8F, 0.7F));
  addRings(scene.regions, &regions);
  Marker obstacles = marker(frame, "obstacles", Marker::LINE_LIST, 0.15, color(0.8F, 0.2F, 0.2F));
  addRings(scene.obstacles, &obstacles);
  Marker conflicts = marker(frame, "conflicts", Marker::LINE_LIST, 0.3, kRed);
  addRings(scene.conflicts, &conflicts);

  MarkerArray array;
  for (Marker* part : {&route, &path, &footprints, &way_points, &regions, &obstacles, &conflicts}) {
    if (part->points.empty()) part->action = Marker::DELETE;
    array.markers.push_back(std::move(*part));
  }
  const double arrow_length = scene.with_footprints ? kManoeuvreArrow : kRouteArrow;
  array.markers.push_back(arrow(frame, "start", scene.start, arrow_length, kForward));
  array.markers.push_back(arrow(frame, "goal", scene.goal, arrow_length, kRed));
  return array;
}

nav_msgs::Path toNavPath(const Path& path, const std::string& frame) {
  nav_msgs::Path msg;
  msg.header.frame_id = frame;
  msg.header.stamp = ros::Time::now();
  msg.poses.resize(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    msg.poses[i].header = msg.header;
    msg.poses[i].pose.position = raised(path[i].pose().position(), 0.0);
    msg.poses[i].pose.orientation = rotation(path[i].heading);
  }
  return msg;
}

}  // namespace external_command
