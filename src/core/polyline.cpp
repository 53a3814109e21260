// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/polyline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "external_command/core/polygon.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kMinSegment = 1e-3;  // [m]

}  // namespace

Polyline::Polyline(std::vector<Point2d> points) : points_(std::move(points)) {
  s_.reserve(points_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point2d point = points_[i];
    if (!isPlausible(point)) {
      throw std::invalid_argument(text("point ", i, " is not finite, or lies beyond 100,000 km"));
    }
    const double step = count == 0 ? 0.0 : (point - points_[count - 1]).norm();
    if (count > 0 && step < kMinSegment) continue;
    s_.push_back(count == 0 ? 0.0 : s_.back() + step);
    points_[count++] = point;
  }
  points_.resize(count);
  if (points_.size() < 2) {
    throw std::invalid_argument(text(points_.size(), " distinct points; at least 2 are needed"));
  }
}

std::size_t Polyline::segmentAt(double s) const {
  const auto after = std::upper_bound(s_.begin(), s_.end(), s);
  const auto index = after == s_.begin() ? 0 : static_cast<std::size_t>(after - s_.begin()) - 1;
  return std::min(index, points_.size() - 2);
}

Point2d Polyline::pointAt(double s) const {
  const std::size_t i = segmentAt(s);
  const double share = std::clamp((s - s_[i]) / (s_[i + 1] - s_[i]), 0.0, 1.0);
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

double Polyline::headingAt(double s) const {
  const std::size_t i = segmentAt(s);
  return headingOf(points_[i + 1] - points_[i]);
}

Pose2d Polyline::poseAt(double s) const {
  const Point2d point = pointAt(s);
  return {point.x(), point.y(), headingAt(s)};
}

FrenetPoint Polyline::project(const Point2d& point) const {
  double best = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  Point2d foot = points_.front();
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const Point2d candidate = nearestOnSegment(point, points_[i], points_[i + 1]);
    const double squared = (point - candidate).squaredNorm();
    if (squared < best) {
      best = squared;
      nearest = i;
      foot = candidate;
    }
  }
  const Point2d along = (points_[nearest + 1] - points_[nearest]).normalized();
  return {s_[nearest] + (foot - points_[nearest]).norm(), cross(along, point - foot), std::sqrt(best)};
}

Polyline Polyline::slice(double from, double to) const {
  from = std::clamp(from, 0.0, length());
  to = std::clamp(to, 0.0, length());
  if (to - from < kMinSegment) {
    throw std::invalid_argument(text("part from s ", from, " to ", to, " m is shorter than 1 mm"));
  }
  std::vector<Point2d> part = {pointAt(from)};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (s_[i] > from + kMinSegment && s_[i] < to - kMinSegment) part.push_back(points_[i]);
  }
  part.push_back(pointAt(to));
  return Polyline(std::move(part));
}

std::vector<double> headingsOf(const std::vector<Point2d>& points) {
  std::vector<double> headings(points.size(), 0.0);
  for (std::size_t i = 0; points.size() > 1 && i < points.size(); ++i) {
    const Point2d& before = points[i == 0 ? 0 : i - 1];
    const Point2d& after = points[std::min(i + 1, points.size() - 1)];
    headings[i] = headingOf(after - before);
  }
  return headings;
}

std::vector<double> curvaturesOf(const std::vector<Point2d>& points) {
  std::vector<double> kappas(points.size(), 0.0);
  if (points.size() < 3) return kappas;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point2d in = points[i] - points[i - 1], out = points[i + 1] - points[i];
    const double product = in.norm() * out.norm() * (in + out).norm();
    kappas[i] = product > 0.0 ? 2.0 * cross(in, out) / product : 0.0;
  }
  kappas.front() = kappas[1];
  kappas.back() = kappas[kappas.size() - 2];
  return kappas;
}

}  // namespace external_command
