// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "motion/footprint_index.h"

namespace external_command {

/// Shortest way for the rear-axle centre to a target past the obstacles, the vehicle taken as the disc that its
/// footprint contains around that point: a lower bound (but for the grid's 8 directions) that knows about walls.
class DistanceMap {
 public:
  /// @param area  what the search covers; its cells are enlarged where it is huge.
  DistanceMap(const FootprintIndex& index, const BoundingBox& area, const Pose2d& target);

  /// [m]; infinity where the target cannot be reached, or outside the area.
  double at(double x, double y) const;

 private:
  long cellAt(double x, double y) const;
  void flood(const FootprintIndex& index, const Pose2d& target);

  Point2d corner_;
  double cell_size_;
  long columns_;
  long rows_;
  std::vector<float> distances_;
};

}  // namespace external_command
