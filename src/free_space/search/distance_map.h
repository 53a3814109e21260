// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell_grid.h"
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
  CellGrid grid_;
  std::vector<float> distances_;
};

}  // namespace external_command
