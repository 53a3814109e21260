// SPDX-License-Identifier: Apache-2.0
#include "marker_shapes.h"

#include <cmath>

namespace external_command {

using visualization_msgs::Marker;

std_msgs::ColorRGBA color(float r, float g, float b, float a) {
  std_msgs::ColorRGBA made;
  made.r = r;
  made.g = g;
  made.b = b;
  made.a = a;
  return made;
}

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

Marker textMarker(const std::string& frame, const std::string& ns, const std::string& words, const Point2d& place,
                  double height, const std_msgs::ColorRGBA& paint) {
  Marker made = marker(frame, ns, Marker::TEXT_VIEW_FACING, 0.0, paint);
  made.scale.z = height;
  made.pose.position = raised(place, kTextHeight);
  made.text = words;
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

void addTriangles(const std::vector<Point2d>& corners, double height, Marker* triangles) {
  for (const Point2d& corner : corners) triangles->points.push_back(raised(corner, height));
}

}  // namespace external_command
