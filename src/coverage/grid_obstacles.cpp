// SPDX-License-Identifier: Apache-2.0
#include "grid_obstacles.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geometry.h"

namespace external_command {

namespace {

constexpr double kFinest = 0.2;     ///< side of the blocks that cells are taken together to, at least [m]
constexpr double kNear = 1.0;       ///< cells farther from the area's box are left out [m]
constexpr double kHullShare = 1.3;  ///< of an obstacle's area that its convex hull may have and be taken for it
constexpr double kSmall = 3.0;      ///< an obstacle up to this size is taken as its hull [m]

using Block = std::pair<long, long>;  // row, column

class Outliner {
 public:
  Outliner(const OccupancyGrid& grid, const Polygon& within)
      : grid_(grid), box_(within.box()), cells_(std::max(1L, std::lround(kFinest / grid.resolution))) {}

  std::vector<Polygon> outline() {
    findBlocks();
    std::vector<shapes::Shapes> runs;
    for (auto block = blocks_.begin(); block != blocks_.end();) {
      const Block first = *block;
      long end = first.second;
      while (block != blocks_.end() && block->first == first.first && block->second == end) ++block, ++end;
      runs.push_back(only(runShape(first.first, first.second, end)));
    }
    std::vector<Polygon> polygons;
    for (const shapes::Shape& shape : unionOf(std::move(runs))) {
      polygons.push_back(outlineOf(shape));
    }
    return polygons;
  }

 private:
  double side() const { return static_cast<double>(cells_) * grid_.resolution; }

  Point2d toMap(double x, double y) const { return compose(grid_.origin, {x, y, 0.0}).position(); }

  void findBlocks() {
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      if (grid_.cells[i] < grid_.blocked_from) continue;
      const auto column = static_cast<long>(i % grid_.width), row = static_cast<long>(i / grid_.width);
      const Point2d at = toMap((static_cast<double>(column) + 0.5) * grid_.resolution,
                               (static_cast<double>(row) + 0.5) * grid_.resolution);
      const bool is_near = ((at - box_.min).array() > -kNear).all() && ((box_.max - at).array() > -kNear).all();
      if (is_near) blocks_.emplace(row / cells_, column / cells_);
    }
  }

  shapes::Shape runShape(long row, long begin, long end) const {
    const double low = static_cast<double>(row) * side(), high = low + side();
    const double left = static_cast<double>(begin) * side(), right = static_cast<double>(end) * side();
    return shapeOf({toMap(left, low), toMap(right, low), toMap(right, high), toMap(left, high)});
  }

  /// The convex hull where that takes little away; else the outline without its steps.
  Polygon outlineOf(const shapes::Shape& shape) const {
    const shapes::Ring hull = hullOf(shape);
    Polygon polygon(pointsOf(hull), "an obstacle of the grid");
    const bool is_small = (polygon.box().max - polygon.box().min).maxCoeff() < kSmall;
    if (is_small || polygon.area() < kHullShare * areaOf(shape.outer())) return polygon;
    const shapes::Shapes larger = grown(only(shape), side() / 2.0);
    return {pointsOf(simplified(larger.front().outer(), side() / 2.0)), "an obstacle of the grid"};
  }

  const OccupancyGrid& grid_;
  const BoundingBox& box_;
  long cells_;  ///< in a block, along each side
  std::set<Block> blocks_;
};

}  // namespace

std::vector<Polygon> gridObstacles(const OccupancyGrid& grid, const Polygon& within) {
  Region::Parts parts;
  parts.grid = grid;
  const Region checked(std::move(parts));  // refuses a grid whose size and cells do not agree
  return Outliner(grid, within).outline();
}

}  // namespace external_command
