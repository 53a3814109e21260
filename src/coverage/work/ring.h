// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

/// A closed line with what is free on its left, cut where it bends more sharply than a vehicle can follow.
class Ring {
 public:
  /// A stretch of vertices that turns too much for its length.
  struct Bend {
    double begin = 0.0;  ///< arc length of the first vertex [m]
    double end = 0.0;    ///< of the last; beyond length() where it runs over the first point [m]
    double turn = 0.0;   ///< positive to the left [rad]
  };

  Ring(const std::vector<Point2d>& points, double radius);

  double length() const { return length_; }
  const std::vector<Bend>& bends() const { return bends_; }

  /// The line from arc length `from` on to `to`, which may run over the first point.
  std::vector<Point2d> part(double from, double to) const;

  /// Position and direction at an arc length; at a vertex the mean direction.
  Pose2d poseAt(double s) const;

 private:
  void findBends(double radius, double sign);

  std::vector<Point2d> points_;
  std::vector<double> s_;      ///< arc length of each point
  std::vector<double> turns_;  ///< at each point [rad]
  double length_ = 0.0;
  std::vector<Bend> bends_;
};

}  // namespace external_command
