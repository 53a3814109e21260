// SPDX-License-Identifier: Apache-2.0
#include "grid_obstacles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "geometry.h"

namespace external_command {

namespace {

constexpr double kFinest = 0.2;     ///< side of the blocks that cells are taken together to, at least [m]
constexpr double kNear = 1.0;       ///< cells farther from the area's box are left out [m]
constexpr double kHullShare = 1.3;  ///< of an obstacle's area that its convex hull may have and be taken for it
constexpr double kSmall = 3.0;      ///< an obstacle up to this size is taken as its hull [m]
constexpr double kRoom = 6.0;       ///< free room inside an obstacle that is smaller holds no vehicle [m^2]

class Outliner {
 public:
  Outliner(const OccupancyGrid& grid, const Polygon& within, std::size_t max_rows, const Checkpoint& checkpoint)
      : grid_(grid),
        box_(within.box()),
        max_rows_(max_rows),
        checkpoint_(checkpoint),
        cells_(std::max(1L, std::lround(kFinest / grid.resolution))) {}

  std::vector<Polygon> outline() {
    std::vector<shapes::Shapes> runs;
    std::vector<bool> row(static_cast<std::size_t>(blockOf(grid_.width - 1)) + 1);
    for (long index = 0; index <= blockOf(grid_.height - 1); ++index) {
      findBlocks(index, &row);
      addRuns(index, row, &runs);
    }
    std::vector<Polygon> polygons;
    for (const shapes::Shape& shape : unionOf(std::move(runs), checkpoint_)) addOutlines(shape, &polygons);
    if (grid_.outside_is_blocked) addOutside(&polygons);
    return polygons;
  }

 private:
  double side() const { return static_cast<double>(cells_) * grid_.resolution; }

  Point2d toMap(double x, double y) const { return compose(grid_.origin, {x, y, 0.0}).position(); }

  bool isBlocked(int value) const { return value < 0 ? grid_.unknown_is_blocked : value >= grid_.blocked_from; }

  void requireFew(std::size_t runs) const {
    if (runs < max_rows_) return;
    throw InvalidRequest(text("the obstacle grid has more than ", max_rows_, " rows of obstacles in the area ",
                              "(~coverage/max_grid_rows); give a smaller area, or a grid with less noise"));
  }

  long blockOf(std::size_t cell) const { return static_cast<long>(cell) / cells_; }

  /// One row of blocks at a time: those of a whole grid would take far more memory than the grid.
  /// @param row  becomes true where a cell of the block is an obstacle near the area.
  void findBlocks(long index, std::vector<bool>* row) const {
    std::fill(row->begin(), row->end(), false);
    const auto first = static_cast<std::size_t>(index * cells_);
    const std::size_t end = std::min<std::size_t>(first + static_cast<std::size_t>(cells_), grid_.height);
    for (std::size_t y = first; y < end; ++y) {
      checkpoint_();
      for (std::size_t x = 0; x < grid_.width; ++x) {
        const auto block = static_cast<std::size_t>(blockOf(x));
        if (!(*row)[block] && isBlocked(grid_.cells[y * grid_.width + x]) && isNear(x, y)) (*row)[block] = true;
      }
    }
  }

  bool isNear(std::size_t x, std::size_t y) const {
    const Point2d at =
        toMap((static_cast<double>(x) + 0.5) * grid_.resolution, (static_cast<double>(y) + 0.5) * grid_.resolution);
    return ((at - box_.min).array() > -kNear).all() && ((box_.max - at).array() > -kNear).all();
  }

  void addRuns(long index, const std::vector<bool>& row, std::vector<shapes::Shapes>* runs) const {
    for (auto begin = std::find(row.begin(), row.end(), true); begin != row.end();) {
      const auto end = std::find(begin, row.end(), false);
      requireFew(runs->size());
      runs->push_back(only(runShape(index, begin - row.begin(), end - row.begin())));
      begin = std::find(end, row.end(), true);
    }
  }

  shapes::Shape runShape(long row, long begin, long end) const {
    const double low = static_cast<double>(row) * side(), high = low + side();
    const double left = static_cast<double>(begin) * side(), right = static_cast<double>(end) * side();
    return shapeOf({toMap(left, low), toMap(right, low), toMap(right, high), toMap(left, high)});
  }

  /// A polygon has no holes: a shape around free room, a fence for example, is cut in two across it.
  void addOutlines(const shapes::Shape& shape, std::vector<Polygon>* polygons) const {
    checkpoint_();
    const auto is_room = [](const shapes::Ring& ring) { return std::abs(areaOf(ring)) > kRoom; };
    const auto room = std::find_if(shape.inners().begin(), shape.inners().end(), is_room);
    if (room == shape.inners().end()) return polygons->push_back(outlineOf(shape));
    const BoundingBox outer = boxOf(shape.outer()), inner = boxOf(*room);
    const double middle = 0.5 * (inner.min.y() + inner.max.y());
    for (const auto& [low, high] : {std::pair(outer.min.y() - 1.0, middle), std::pair(middle, outer.max.y() + 1.0)}) {
      const shapes::Shape half = shapeOf({{outer.min.x() - 1.0, low},
                                          {outer.max.x() + 1.0, low},
                                          {outer.max.x() + 1.0, high},
                                          {outer.min.x() - 1.0, high}});
      for (const shapes::Shape& part : intersection(only(shape), only(half))) addOutlines(part, polygons);
    }
  }

  /// What lies beyond the grid's four sides, as far as the area goes.
  void addOutside(std::vector<Polygon>* polygons) const {
    const double width = grid_.width * grid_.resolution, height = grid_.height * grid_.resolution;
    const Point2d middle = toMap(width / 2.0, height / 2.0);
    const double reach = (box_.min - middle).cwiseAbs().cwiseMax((box_.max - middle).cwiseAbs()).norm();
    const double factor = 1.0 + 2.0 * reach / std::min(width, height);
    const Point2d corners[] = {toMap(0.0, 0.0), toMap(width, 0.0), toMap(width, height), toMap(0.0, height)};
    for (std::size_t i = 0; i < 4; ++i) {
      const Point2d &a = corners[i], &b = corners[(i + 1) % 4];
      const Point2d far_a = middle + factor * (a - middle), far_b = middle + factor * (b - middle);
      polygons->push_back(Polygon({a, far_a, far_b, b}, "what lies beyond the grid"));
    }
  }

  static BoundingBox boxOf(const shapes::Ring& ring) {
    BoundingBox box{ring[0], ring[0]};
    for (const Point2d& point : ring) {
      box.min = box.min.cwiseMin(point);
      box.max = box.max.cwiseMax(point);
    }
    return box;
  }

  /// The convex hull where that takes little away; else the outline without its steps.
  Polygon outlineOf(const shapes::Shape& shape) const {
    const shapes::Ring hull = hullOf(shape);
    Polygon polygon(pointsOf(hull), "an obstacle of the grid");
    const bool is_small = (polygon.box().max - polygon.box().min).maxCoeff() < kSmall;
    if (is_small || polygon.area() < kHullShare * areaOf(shape.outer())) return polygon;
    const shapes::Shapes larger = grown(only(shape), side() / 2.0, checkpoint_);
    return {pointsOf(simplified(larger.front().outer(), side() / 2.0)), "an obstacle of the grid"};
  }

  const OccupancyGrid& grid_;
  const BoundingBox& box_;
  const std::size_t max_rows_;
  const Checkpoint& checkpoint_;
  const long cells_;  ///< in a block, along each side
};

}  // namespace

std::vector<Polygon> gridObstacles(const OccupancyGrid& grid, const Polygon& within, std::size_t max_rows,
                                   const Checkpoint& checkpoint) {
  Region::Parts parts;
  parts.grid = grid;
  const Region checked(std::move(parts));  // refuses a grid whose size and cells do not agree
  return Outliner(grid, within, max_rows, checkpoint).outline();
}

}  // namespace external_command
