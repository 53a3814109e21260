// SPDX-License-Identifier: Apache-2.0
#include "draft_markers.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kHeight = 1.5;               // above what the gateway draws [m]
constexpr double kArrow = 8.0;                // [m]
constexpr double kPoint = 2.5;                // [m]
constexpr std::size_t kMaxPathPoints = 5000;  // drawn

std_msgs::ColorRGBA color(float r, float g, float b) {
  std_msgs::ColorRGBA made;
  made.r = r;
  made.g = g;
  made.b = b;
  made.a = 1.0F;
  return made;
}

const auto kGoal = color(1.0F, 0.2F, 0.8F);
const auto kForward = color(0.2F, 1.0F, 1.0F);
const auto kReverse = color(1.0F, 0.55F, 0.1F);

geometry_msgs::Point raised(double x, double y) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  point.z = kHeight;
  return point;
}

Marker marker(const std::string& ns, int type, double scale, const std_msgs::ColorRGBA& paint) {
  Marker made;
  made.header.frame_id = "map";
  made.ns = ns;
  made.type = type;
  made.action = Marker::ADD;
  made.pose.orientation.w = 1.0;
  made.scale.x = scale;
  if (type == Marker::SPHERE_LIST) made.scale.y = made.scale.z = scale;
  made.color = paint;
  return made;
}

/// An arrow; a ball where there is no heading.
Marker goalMarker(const std::optional<Pose>& goal) {
  Marker made = marker("draft_goal", goal && !goal->has_heading ? Marker::SPHERE : Marker::ARROW, kArrow, kGoal);
  made.scale.y = made.scale.z = kArrow / 4.0;
  if (!goal) {
    made.action = Marker::DELETE;
    return made;
  }
  if (!goal->has_heading) made.scale.x = kArrow / 4.0;
  made.pose.position = raised(goal->x, goal->y);
  made.pose.orientation.z = std::sin(goal->heading / 2.0);
  made.pose.orientation.w = std::cos(goal->heading / 2.0);
  return made;
}

Marker pathMarker(const PlannedPath& path) {
  Marker made = marker("draft_path", Marker::LINE_LIST, 0.7, kForward);
  const std::size_t step = 1 + path.points.size() / kMaxPathPoints;
  for (std::size_t i = 0; i + 1 < path.points.size(); i += step) {
    const PathPoint& from = path.points[i];
    const PathPoint& to = path.points[std::min(i + step, path.points.size() - 1)];
    made.points.push_back(raised(from.x, from.y));
    made.points.push_back(raised(to.x, to.y));
    made.colors.resize(made.points.size(), to.direction == PathPoint::REVERSE ? kReverse : kForward);
  }
  return made;
}

}  // namespace

MarkerArray draftMarkers(const CommandDraft& draft, const std::optional<MapObject>& object, const PlannedPath& path) {
  Marker points = marker("draft_points", Marker::SPHERE_LIST, kPoint, kGoal);
  Marker line = marker("draft_line", Marker::LINE_LIST, 0.5, kGoal);
  if (draft.takesPoints()) {
    for (const geometry_msgs::Point& point : draft.points) points.points.push_back(raised(point.x, point.y));
  }
  if (draft.kind == CommandKind::kPathFollow) {
    for (std::size_t i = 0; i + 1 < points.points.size(); ++i) {
      line.points.push_back(points.points[i]);
      line.points.push_back(points.points[i + 1]);
    }
  }
  Marker outline = marker("draft_object", Marker::LINE_LIST, 0.4, kGoal);
  if (object && object->kind == draft.objectKind() && object->id == draft.object_id) {
    for (std::size_t i = 0, j = object->outline.size() - 1; i < object->outline.size(); j = i++) {
      outline.points.push_back(raised(object->outline[j].x, object->outline[j].y));
      outline.points.push_back(raised(object->outline[i].x, object->outline[i].y));
    }
  }
  MarkerArray array;
  array.markers = {points, line, outline, pathMarker(path)};
  for (Marker& made : array.markers) {
    if (made.points.empty()) made.action = Marker::DELETE;
  }
  array.markers.push_back(goalMarker(draft.needsGoal() ? draft.goal : std::nullopt));
  return array;
}

}  // namespace external_command
