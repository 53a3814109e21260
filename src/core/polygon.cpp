// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/polygon.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "polygon_area.h"
#include "simple_polygon.h"

namespace external_command {

namespace {

constexpr double kMinEdge = 1e-3;  // [m]

void requireSimple(const std::vector<Point2d>& points, const std::string& name) {
  const auto edges = meetingEdges(points);
  if (!edges) return;
  throw InvalidRequest(text(name, " crosses or touches itself: the edge from vertex ", edges->first, " ",
                            at(points[edges->first]), " meets the edge from vertex ", edges->second, " ",
                            at(points[edges->second]), "; give the corners of a simple polygon in order"));
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

Polygon::Polygon(const std::vector<Point2d>& points, std::string name) : name_(std::move(name)) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InvalidRequest(text(name_, " vertex ", i, " is not finite"));
    if (!isPlausible(points[i])) {
      throw InvalidRequest(
          text(name_, " vertex ", i, " lies beyond 100,000 km; give coordinates of the map in metres"));
    }
    if (points_.empty() || (points[i] - points_.back()).norm() >= kMinEdge) points_.push_back(points[i]);
  }
  while (points_.size() > 1 && (points_.front() - points_.back()).norm() < kMinEdge) points_.pop_back();
  if (points_.size() < 3) {
    throw InvalidRequest(text(name_, " has ", points_.size(), " distinct vertices; at least 3 are needed"));
  }
  if (signedArea(points_) < 0.0) std::reverse(points_.begin(), points_.end());
  area_ = std::abs(signedArea(points_));  // so that a polygon of the same points has the same, to the last digit
  requireSimple(points_, name_);
  if (area_ < kMinPolygonArea) throw InvalidRequest(text(name_, " has no area: ", area_, " m^2 inside its vertices"));
  box_ = boxOf(points_);
}

Polygon Polygon::movedBy(const Point2d& offset) const {
  Polygon moved = *this;
  for (Point2d& point : moved.points_) point += offset;
  moved.box_ = boxOf(moved.points_);
  return moved;
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
