// SPDX-License-Identifier: Apache-2.0
#include "parking_heading.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lane_search.h"

namespace external_command {

namespace {

constexpr double kClearlyLonger = 1.15;
constexpr double kNoMore = 0.01;  // that a full turn may be exceeded by for rounding [rad]

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

bool isInDegrees(const Polygon& space, double heading) {
  if (std::abs(heading) <= 2.0 * M_PI + kNoMore) return false;
  // From the nearest of the four directions along and across.
  const auto error = [&](double angle) { return std::abs(std::remainder(angle - longAxis(space), M_PI / 2.0)); };
  return error(heading * M_PI / 180.0) < error(heading);
}

bool putInOrder(std::vector<Point2d>* corners) {
  std::vector<Point2d>& c = *corners;
  if (c.size() != 4) return false;
  const auto crosses = [&](std::size_t a, std::size_t b, std::size_t d, std::size_t e) {
    return cross(c[b] - c[a], c[d] - c[a]) * cross(c[b] - c[a], c[e] - c[a]) < 0.0 &&
           cross(c[e] - c[d], c[a] - c[d]) * cross(c[e] - c[d], c[b] - c[d]) < 0.0;
  };
  // In a convex shape the diagonals cross and the sides do not: where two sides cross they are its diagonals.
  if (crosses(0, 1, 2, 3)) {
    std::swap(c[1], c[2]);
  } else if (crosses(1, 2, 3, 0)) {
    std::swap(c[2], c[3]);
  } else {
    return false;
  }
  return true;
}

bool fitsParkingSpace(const Polygon& space, double heading) {
  const Point2d along = unitVector(longAxis(space)), across(-along.y(), along.x());
  if (extent(space, along) < kClearlyLonger * extent(space, across)) return true;
  return std::abs(unitVector(heading).dot(along)) >= std::sqrt(0.5);
}

}  // namespace external_command
