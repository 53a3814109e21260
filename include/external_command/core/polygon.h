// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

struct BoundingBox {
  Point2d min;
  Point2d max;
};

/// A simple polygon, counter-clockwise, first point not repeated. Immutable and thread-safe.
class Polygon {
 public:
  /// Either orientation; a repeated first point and consecutive points nearer than 1 mm are dropped. O(n log n).
  /// @param name  what error texts call it: "non_drivable_roi[2]", "parking space p7".
  /// @throws InvalidRequest  a point is not plausible (pose.h), fewer than 3 distinct points, no area, or it crosses
  ///                         itself: the text names the vertex.
  Polygon(const std::vector<Point2d>& points, std::string name);

  /// The same polygon elsewhere, without another check.
  Polygon movedBy(const Point2d& offset) const;

  const std::string& name() const { return name_; }
  const std::vector<Point2d>& points() const { return points_; }
  double area() const { return area_; }  ///< [m^2], positive
  const BoundingBox& box() const { return box_; }

  /// True inside and on the border. O(n).
  bool contains(const Point2d& point) const;

  /// Distance [m] to the border; 0 on it, positive inside and outside alike. O(n).
  double distanceToBorder(const Point2d& point) const;

 private:
  std::string name_;
  std::vector<Point2d> points_;
  double area_;
  BoundingBox box_;
};

/// Point of the segment `a`-`b` nearest to `point`.
Point2d nearestOnSegment(const Point2d& point, const Point2d& a, const Point2d& b);

}  // namespace external_command
