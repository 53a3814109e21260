// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "coverage_case.h"

namespace external_command {
namespace benchmark {

/// Whether a vehicle's whole footprint lies inside a field and out of its holes. Exact.
class FootprintCheck {
 public:
  /// @param tolerance  that the footprint is shrunk by all round [m].
  FootprintCheck(const CoverageCase& field, double tolerance);
  ~FootprintCheck();

  bool isInside(const Pose2d& pose) const;

  /// A distance [m] that the rear axle may move from `pose`, where the footprint is inside, without leaving.
  double freeDistance(const Pose2d& pose) const;

 private:
  struct Borders;
  bool holds(const Point2d& point) const;
  bool touches(const Point2d& a, const Point2d& b, const Pose2d& pose) const;

  std::unique_ptr<const Borders> borders_;
  Point2d low_, high_;  ///< corners of the footprint, seen from the rear axle
  double radius_;       ///< of the footprint around the rear axle [m]
};

}  // namespace benchmark
}  // namespace external_command
