// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/polygon.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <limits>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>, false, true>;

constexpr double kMinEdge = 1e-3;  // [m]
constexpr double kMinArea = 1e-4;  // [m^2]

double signedArea(const std::vector<Point2d>& points) {
  double twice = 0.0;  // relative to the first point: UTM coordinates would eat the digits
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    twice += cross(points[i] - points[0], points[i + 1] - points[0]);
  }
  return twice / 2.0;
}

bool segmentsMeet(const Point2d& a, const Point2d& b, const Point2d& c, const Point2d& d) {
  const auto nearer = [](const Point2d& p, const Point2d& q, const Point2d& r) {
    return (p - nearestOnSegment(p, q, r)).squaredNorm() < 1e-12;
  };
  if (nearer(a, c, d) || nearer(b, c, d) || nearer(c, a, b) || nearer(d, a, b)) return true;
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

/// Names the first pair of edges that meet; only called for polygons already known to be invalid. O(n^2), therefore not
/// for large ones.
std::string whereItCrossesItself(const std::vector<Point2d>& points) {
  constexpr std::size_t kMaxSize = 2000;
  const std::size_t n = points.size();
  if (n > kMaxSize) return "";
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segmentsMeet(points[i], points[i + 1], points[j], points[(j + 1) % n])) {
        return text(": the edge from vertex ", i, " ", at(points[i]), " meets the edge from vertex ", j, " ",
                    at(points[j]));
      }
    }
  }
  return "";
}

/// True where, seen from the first vertex, the others follow each other counter-clockwise within half a turn: nothing
/// crosses then. Holds for every strictly convex polygon, and saves the general test.
bool isFan(const std::vector<Point2d>& points) {
  const Point2d first = points[1] - points[0];
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point2d next = points[i + 1] - points[0];
    if (cross(points[i] - points[0], next) < kMinArea || cross(first, next) < kMinArea) return false;
  }
  return true;
}

void requireSimple(const std::vector<Point2d>& points, const std::string& name) {
  if (isFan(points)) return;
  BoostPolygon polygon;
  for (const Point2d& point : points) {
    polygon.outer().emplace_back(point.x() - points[0].x(), point.y() - points[0].y());
  }
  polygon.outer().push_back(polygon.outer().front());
  std::string reason;
  if (bg::is_valid(polygon, reason)) return;
  throw InvalidRequest(text(name, " crosses or touches itself", whereItCrossesItself(points),
                            "; give the corners of a simple polygon in order"));
}

BoundingBox boxOf(const std::vector<Point2d>& points) {
  BoundingBox box{points[0], points[0]};
  for (const Point2d& point : points) {
    box.min = box.min.cwiseMin(point);
    box.max = box.max.cwiseMax(point);
  }
  return box;
}

}  // namespace

Polygon::Polygon(const std::vector<Point2d>& points, const std::string& name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InvalidRequest(text(name, " vertex ", i, " is not finite"));
    if (!isPlausible(points[i])) {
      throw InvalidRequest(text(name, " vertex ", i, " lies beyond 100,000 km; give coordinates of the map in metres"));
    }
    if (points_.empty() || (points[i] - points_.back()).norm() >= kMinEdge) points_.push_back(points[i]);
  }
  while (points_.size() > 1 && (points_.front() - points_.back()).norm() < kMinEdge) points_.pop_back();
  if (points_.size() < 3) {
    throw InvalidRequest(text(name, " has ", points_.size(), " distinct vertices; at least 3 are needed"));
  }
  const double area = signedArea(points_);
  if (area < 0.0) std::reverse(points_.begin(), points_.end());
  area_ = std::abs(area);
  requireSimple(points_, name);
  if (area_ < kMinArea) throw InvalidRequest(text(name, " has no area: ", area_, " m^2 inside its vertices"));
  box_ = boxOf(points_);
}

bool Polygon::contains(const Point2d& point) const {
  if ((point.array() < box_.min.array()).any() || (point.array() > box_.max.array()).any()) return false;
  bool inside = false;
  for (std::size_t i = 0, j = points_.size() - 1; i < points_.size(); j = i++) {
    const Point2d &a = points_[i], &b = points_[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) inside = !inside;
  }
  return inside || distanceToBorder(point) < 1e-9;
}

double Polygon::distanceToBorder(const Point2d& point) const {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = points_.size() - 1; i < points_.size(); j = i++) {
    squared = std::min(squared, (point - nearestOnSegment(point, points_[j], points_[i])).squaredNorm());
  }
  return std::sqrt(squared);
}

Point2d nearestOnSegment(const Point2d& point, const Point2d& a, const Point2d& b) {
  const Point2d along = b - a;
  const double squared = along.squaredNorm();
  if (squared == 0.0) return a;
  return a + std::clamp((point - a).dot(along) / squared, 0.0, 1.0) * along;
}

}  // namespace external_command
