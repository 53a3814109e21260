// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/obstacle_polygon.h"

#include <algorithm>
#include <cmath>

#include "polygon_area.h"

namespace external_command {

namespace {

constexpr double kThickening = 0.01;  // around an obstacle that has no area [m]
constexpr double kThin = 1e-3;        // [m]
constexpr double kSmall = 0.1;        // obstacles within this may have next to no area [m]

}  // namespace

Polygon obstaclePolygon(const std::vector<Point2d>& points, const std::string& name) {
  const auto isPlace = [](const Point2d& point) { return point.allFinite() && isPlausible(point); };
  if (points.empty() || !std::all_of(points.begin(), points.end(), isPlace)) return Polygon(points, name);
  const auto isNearer = [&](const Point2d& a, const Point2d& b) {
    return (a - points[0]).squaredNorm() < (b - points[0]).squaredNorm();
  };
  const Point2d longest = *std::max_element(points.begin(), points.end(), isNearer) - points[0];
  const double length = longest.norm();
  const Point2d along = length > 0.0 ? Point2d(longest / length) : Point2d(1.0, 0.0), across(-along.y(), along.x());
  Point2d low = Point2d::Zero(), high = Point2d::Zero();  // seen from the first point
  for (const Point2d& point : points) {
    const Point2d seen(along.dot(point - points[0]), across.dot(point - points[0]));
    low = low.cwiseMin(seen);
    high = high.cwiseMax(seen);
  }
  const Point2d size = high - low;
  const bool has_area = std::abs(signedArea(points)) >= kMinPolygonArea || size.maxCoeff() >= kSmall;
  if (size.y() >= kThin && has_area) return Polygon(points, name);
  low -= Point2d(kThickening, kThickening);
  high += Point2d(kThickening, kThickening);
  const auto corner = [&](double x, double y) -> Point2d { return points[0] + x * along + y * across; };
  return Polygon(
      {corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()), corner(low.x(), high.y())},
      name);
}

}  // namespace external_command
