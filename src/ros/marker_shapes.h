// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <visualization_msgs/Marker.h>

#include <optional>
#include <string>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

// One above the other, so that what matters more is not hidden [m].
constexpr double kSurfaceHeight = -0.2;
constexpr double kLineHeight = 0.0;
constexpr double kRouteHeight = 0.2;
constexpr double kPathHeight = 0.4;
constexpr double kPoseHeight = 0.6;
constexpr double kTextHeight = 1.0;

/// A colour of what is drawn, each part in [0, 1].
std_msgs::ColorRGBA color(float r, float g, float b, float a = 1.0F);

/// The colours; the legend tells what they mean.
namespace paint {
const auto kLane = color(0.30F, 0.31F, 0.34F);
const auto kOtherLane = color(0.22F, 0.22F, 0.23F);
const auto kCenterLine = color(0.45F, 0.5F, 0.6F);
const auto kWhiteLine = color(0.85F, 0.85F, 0.85F);
const auto kYellowLine = color(0.95F, 0.75F, 0.1F);
const auto kJunction = color(0.5F, 0.4F, 0.7F);
const auto kParkingSpace = color(0.3F, 0.7F, 1.0F);
const auto kArea = color(0.3F, 0.8F, 0.7F);
const auto kRoute = color(0.15F, 0.45F, 0.95F, 0.6F);
const auto kForward = color(0.1F, 0.9F, 0.3F);
const auto kReverse = color(1.0F, 0.45F, 0.0F);
const auto kFootprint = color(0.8F, 0.8F, 0.4F, 0.6F);
const auto kWayPoint = color(0.9F, 0.3F, 0.9F);
const auto kObstacle = color(0.8F, 0.2F, 0.2F);
const auto kConflict = color(0.95F, 0.1F, 0.1F);
const auto kVehicle = color(1.0F, 0.6F, 0.1F);
const auto kText = color(1.0F, 1.0F, 1.0F);
}  // namespace paint

geometry_msgs::Point raised(const Point2d& point, double height);

geometry_msgs::Quaternion rotation(double heading);

/// A marker to be filled. @param scale  width of lines, length of others [m].
visualization_msgs::Marker marker(const std::string& frame, const std::string& ns, int type, double scale,
                                  const std_msgs::ColorRGBA& paint);

/// A text whose middle is at `place`, in letters of `height` [m].
visualization_msgs::Marker textMarker(const std::string& frame, const std::string& ns, const std::string& words,
                                      const Point2d& place, double height, const std_msgs::ColorRGBA& paint);

/// Adds a line through the points, or a closed one, to a LINE_LIST.
void addLine(const std::vector<Point2d>& points, double height, visualization_msgs::Marker* lines);
void addRing(std::vector<Point2d> points, double height, visualization_msgs::Marker* lines);

/// Adds triangles of the corners, three by three, to a TRIANGLE_LIST.
void addTriangles(const std::vector<Point2d>& corners, double height, visualization_msgs::Marker* triangles);

}  // namespace external_command
