// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/map_markers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "marker_shapes.h"

namespace external_command {

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kStraightEnough = 0.02;  // a line's points that turn less than this are left out [rad]
constexpr double kLongestSegment = 25.0;  // [m]
constexpr double kLaneIdHeight = 0.9;     // of letters [m]
constexpr double kSpaceIdHeight = 0.6;    // [m]

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

std::vector<Point2d> thinned(const std::vector<Point2d>& points) {
  std::vector<Point2d> kept;
  for (const std::size_t i : drawnPoints(points)) kept.push_back(points[i]);
  return kept;
}

void addSurface(const Lane& lane, Marker* triangles) {
  const auto& points = lane.center.points();
  const auto headings = headingsOf(points);
  Point2d last_left, last_right;
  bool is_first = true;
  for (const std::size_t i : drawnPoints(points)) {
    const double half = lane.widthAt(lane.center.arcLengths()[i]) / 2.0;
    const Point2d side = half * unitVector(headings[i] + M_PI / 2.0);
    const Point2d left = points[i] + side, right = points[i] - side;
    if (!is_first) {
      addTriangles({last_left, last_right, left, left, last_right, right}, kSurfaceHeight, triangles);
    }
    last_left = left;
    last_right = right;
    is_first = false;
  }
}

void addBoundary(const LaneBoundary& boundary, Marker* lines) {
  if (boundary.is_virtual || boundary.points.size() < 2) return;
  const BoundaryType type = boundary.types.empty() ? BoundaryType::kUnknown : boundary.types.front().type;
  const bool is_yellow =
      type == BoundaryType::kDottedYellow || type == BoundaryType::kSolidYellow || type == BoundaryType::kDoubleYellow;
  addLine(thinned(boundary.points), kLineHeight, lines);
  lines->colors.resize(lines->points.size(), is_yellow ? paint::kYellowLine : paint::kWhiteLine);
}

template <class Object>
void addOutlines(const std::vector<const Object*>& objects, Marker* lines) {
  for (const Object* object : objects) addRing(object->polygon.points(), kLineHeight, lines);
}

Point2d middleOf(const Polygon& polygon) {
  Point2d sum = Point2d::Zero();
  for (const Point2d& point : polygon.points()) sum += point;
  return sum / static_cast<double>(polygon.points().size());
}

/// Adds a text with the next number of its namespace.
void addText(Marker words, int number, MarkerArray* array) {
  words.id = number;
  array->markers.push_back(std::move(words));
}

}  // namespace

MarkerArray mapMarkers(const MapPart& part, const std::string& frame) {
  Marker surfaces = marker(frame, "lanes", Marker::TRIANGLE_LIST, 1.0, paint::kLane);
  Marker others = marker(frame, "other_lanes", Marker::TRIANGLE_LIST, 1.0, paint::kOtherLane);
  Marker centers = marker(frame, "center_lines", Marker::LINE_LIST, 0.08, paint::kCenterLine);
  Marker boundaries = marker(frame, "boundaries", Marker::LINE_LIST, 0.15, paint::kWhiteLine);
  Marker junctions = marker(frame, "junctions", Marker::LINE_LIST, 0.2, paint::kJunction);
  Marker spaces = marker(frame, "parking_spaces", Marker::LINE_LIST, 0.15, paint::kParkingSpace);
  Marker areas = marker(frame, "areas", Marker::LINE_LIST, 0.3, paint::kArea);
  for (const Lane* lane : part.lanes) {
    addSurface(*lane, lane->isDrivable() ? &surfaces : &others);
    if (lane->isDrivable()) addLine(thinned(lane->center.points()), kLineHeight, &centers);
    addBoundary(lane->left, &boundaries);
    addBoundary(lane->right, &boundaries);
  }
  addOutlines(part.junctions, &junctions);
  addOutlines(part.spaces, &spaces);
  addOutlines(part.areas, &areas);

  MarkerArray array;
  for (Marker* made : {&surfaces, &others, &centers, &boundaries, &junctions, &spaces, &areas}) {
    if (made->points.empty()) made->action = Marker::DELETE;
    array.markers.push_back(std::move(*made));
  }
  return array;
}

MarkerArray idMarkers(const MapPart& part, const std::string& frame) {
  MarkerArray array;
  int number = 0;
  for (const Lane* lane : part.lanes) {
    if (lane->is_reversed) continue;
    const Point2d middle = lane->center.pointAt(lane->length() / 2.0);
    addText(textMarker(frame, "lane_ids", lane->id, middle, kLaneIdHeight, paint::kText), number++, &array);
  }
  number = 0;
  for (const ParkingSpace* space : part.spaces) {
    addText(textMarker(frame, "parking_space_ids", space->id, middleOf(space->polygon), kSpaceIdHeight,
                       paint::kParkingSpace),
            number++, &array);
  }
  number = 0;
  for (const Area* area : part.areas) {
    const double height = std::min(std::max(std::sqrt(area->polygon.area()) / 10.0, 1.0), 8.0);
    addText(textMarker(frame, "area_ids", area->id, middleOf(area->polygon), height, paint::kArea), number++, &array);
  }
  return array;
}

}  // namespace external_command
