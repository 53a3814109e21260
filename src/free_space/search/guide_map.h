// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cell_grid.h"
#include "motion/footprint_index.h"

namespace external_command {

/// A point of the guide.
struct GuidePoint {
  Point2d at;
  double room;  ///< at most the distance to the nearest obstacle; 0 in one [m]
};

/// A way that a driver would take through the free space, as a line that knows nothing of turning circles: it is short
/// and keeps to the wide places. A metre where the vehicle hardly fits costs as much as many in the open. Nothing is
/// forbidden, so there always is a way; stretches that turned out to be impassable can be made dear.
class GuideMap {
 public:
  /// @param area  what the way stays in; the cells are enlarged where it is huge.
  /// @param stop  asked now and then, here and by way(): once it says so, there is no way.
  GuideMap(const FootprintIndex& index, const BoundingBox& area, std::function<bool()> stop);

  /// The cheapest way from one point to the other; points about a cell apart. Empty where a point lies outside the
  /// area, or once stopped.
  std::vector<GuidePoint> way(const Point2d& from, const Point2d& to) const;

  /// Makes the tightest place between two points of a way dear.
  void close(const std::vector<GuidePoint>& way, std::size_t first, std::size_t last);

 private:
  CellGrid grid_;
  std::function<bool()> stop_;
  std::vector<std::uint16_t> prices_;  ///< of a cell
  std::vector<float> rooms_;           ///< [m]
};

}  // namespace external_command
