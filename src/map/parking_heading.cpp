// SPDX-License-Identifier: Apache-2.0
#include "parking_heading.h"

#include <cmath>

#include "lane_search.h"

namespace external_command {

namespace {

constexpr double kClearlyLonger = 1.15;

/// Heading of the longer side, one of its two senses: the mean of the edges' directions, each weighted by its squared
/// length, with the angles doubled so that opposite senses agree. Squaring a complex number does both.
double longAxis(const Polygon& polygon) {
  Point2d doubled = Point2d::Zero();
  const std::vector<Point2d>& points = polygon.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2d edge = points[(i + 1) % points.size()] - points[i];
    doubled += Point2d(edge.x() * edge.x() - edge.y() * edge.y(), 2.0 * edge.x() * edge.y());
  }
  return headingOf(doubled) / 2.0;
}

double extent(const Polygon& polygon, const Point2d& direction) {
  const Point2d& first = polygon.points().front();
  double low = 0.0, high = 0.0;
  for (const Point2d& point : polygon.points()) {
    low = std::min(low, (point - first).dot(direction));
    high = std::max(high, (point - first).dot(direction));
  }
  return high - low;
}

Point2d middleOf(const Polygon& polygon) {
  Point2d sum = Point2d::Zero();
  for (const Point2d& point : polygon.points()) sum += point - polygon.points().front();
  return polygon.points().front() + sum / static_cast<double>(polygon.points().size());
}

}  // namespace

double derivedParkingHeading(const MapContent& map, const Polygon& space) {
  const double axis = longAxis(space);
  const Point2d middle = middleOf(space);
  const auto lane = nearestLane(map, middle, {});
  if (!lane) return axis;
  const Point2d along = unitVector(axis);
  const Point2d away = middle - map.lanes[lane->lane].center.pointAt(lane->frenet.s);
  const bool is_beside = std::abs(along.dot(away)) <= std::abs(cross(along, away));
  const Point2d wished = is_beside ? unitVector(lane->heading) : away;
  return along.dot(wished) >= 0.0 ? axis : normalizeAngle(axis + M_PI);
}

bool fitsParkingSpace(const Polygon& space, double heading) {
  const Point2d along = unitVector(longAxis(space)), across(-along.y(), along.x());
  if (extent(space, along) < kClearlyLonger * extent(space, across)) return true;
  return std::abs(unitVector(heading).dot(along)) >= std::sqrt(0.5);
}

}  // namespace external_command
