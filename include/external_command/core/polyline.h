// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "external_command/core/frenet.h"
#include "external_command/core/pose.h"

namespace external_command {

/// A curve of straight segments with its arc length. Immutable and thread-safe.
class Polyline {
 public:
  /// Points nearer than 1 mm to their predecessor are dropped.
  /// @throws std::invalid_argument  a point is not plausible (pose.h), or fewer than two distinct points are left.
  explicit Polyline(std::vector<Point2d> points);

  /// One without points, to which another one is to be assigned before anything else is done with it.
  static Polyline blank() { return Polyline({}, {}); }

  const std::vector<Point2d>& points() const { return points_; }

  /// Arc length [m] of each point; the first is 0.
  const std::vector<double>& arcLengths() const { return s_; }

  double length() const { return s_.back(); }

  /// The point at arc length `s` [m], clamped to the curve. O(log n).
  Point2d pointAt(double s) const;

  /// Heading [rad] of the segment that holds `s`; at a vertex that of the segment that begins there.
  double headingAt(double s) const;

  Pose2d poseAt(double s) const;

  /// The nearest point of the curve. O(n).
  FrenetPoint project(const Point2d& point) const;

  /// The part from `from` to `to` [m], both clamped to the curve.
  /// @throws std::invalid_argument  the part is shorter than 1 mm.
  Polyline slice(double from, double to) const;

 private:
  Polyline(std::vector<Point2d> points, std::vector<double> s) : points_(std::move(points)), s_(std::move(s)) {}

  std::size_t segmentAt(double s) const;

  std::vector<Point2d> points_;
  std::vector<double> s_;
};

/// Heading [rad] per point of a sampled curve: of the central difference, one-sided at the ends.
std::vector<double> headingsOf(const std::vector<Point2d>& points);

/// Signed curvature [1/m] per point: of the circle through the point and its neighbours (Menger), positive to the left;
/// the ends take their neighbour's.
std::vector<double> curvaturesOf(const std::vector<Point2d>& points);

}  // namespace external_command
