// SPDX-License-Identifier: Apache-2.0
#include "obstacle_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

/// The cells `[begin, end)` of one direction of a grid.
struct CellRange {
  long begin;
  long end;
};

/// Reads cells by index.
class GridView {
 public:
  explicit GridView(const OccupancyGrid& grid)
      : grid_(grid), width_(static_cast<long>(grid.width)), height_(static_cast<long>(grid.height)) {}

  bool isBlocked(long column, long row) const {
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return grid_.outside_is_blocked;
    const int value = grid_.cells[static_cast<std::size_t>(row * width_ + column)];
    return value < 0 ? grid_.unknown_is_blocked : value >= grid_.blocked_from;
  }

  bool isBlocked(const Point2d& point) const {
    const Pose2d seen = relativeTo(grid_.origin, {point.x(), point.y(), 0.0});
    const double column = std::floor(seen.x / grid_.resolution), row = std::floor(seen.y / grid_.resolution);
    if (std::abs(column) > 1e9 || std::abs(row) > 1e9) return grid_.outside_is_blocked;
    return isBlocked(static_cast<long>(column), static_cast<long>(row));
  }

  /// The columns and rows that a box of the map reaches into.
  std::pair<CellRange, CellRange> within(const BoundingBox& box) const {
    Point2d low = Point2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const double x : {box.min.x(), box.max.x()}) {
      for (const double y : {box.min.y(), box.max.y()}) {
        const Point2d cell = relativeTo(grid_.origin, {x, y, 0.0}).position() / grid_.resolution;
        low = low.cwiseMin(cell);
        high = high.cwiseMax(cell);
      }
    }
    const auto range = [](double from, double to, long count) {
      const auto most = static_cast<double>(count);
      return CellRange{static_cast<long>(std::clamp(std::floor(from), 0.0, most)),
                       static_cast<long>(std::clamp(std::ceil(to), 0.0, most))};
    };
    return {range(low.x(), high.x(), width_), range(low.y(), high.y(), height_)};
  }

 private:
  const OccupancyGrid& grid_;
  long width_;
  long height_;
};

}  // namespace

LocalObstacles::LocalObstacles(const Region& region, const Point2d& origin, const Checkpoint& checkpoint)
    : region_(&region), origin_(origin) {
  if (region.drivable()) addPolygon(*region.drivable(), kDrivableSource);
  for (std::size_t i = 0; i < region.nonDrivable().size(); ++i) {
    addPolygon(region.nonDrivable()[i], static_cast<int>(i));
  }
  requireFewEdges();
  if (region.grid()) addGrid(*region.grid(), checkpoint);
}

void LocalObstacles::requireFewEdges() const {
  const std::size_t most = region_->limits().max_edges;
  if (edges_.size() <= most) return;
  throw InvalidRequest(text("the borders of the region's obstacles have more than ", most,
                            " edges (~free_space/max_edges); give a smaller region or a coarser grid"));
}

void LocalObstacles::addPolygon(const Polygon& polygon, int source) {
  const std::vector<Point2d>& points = polygon.points();
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    edges_.push_back({points[j] - origin_, points[i] - origin_, source});
  }
}

void LocalObstacles::addGrid(const OccupancyGrid& grid, const Checkpoint& checkpoint) {
  const GridView view(grid);
  const Point2d along = grid.resolution * unitVector(grid.origin.heading);
  const Point2d across(-along.y(), along.x());
  const Point2d corner = grid.origin.position() - origin_;
  CellRange columns{0, static_cast<long>(grid.width)}, rows{0, static_cast<long>(grid.height)};
  // What lies outside the border to stay within is out of reach.
  if (region_->drivable()) std::tie(columns, rows) = view.within(region_->drivable()->box());
  // Borders between a free and a blocked cell, joined to runs: first the lines along x, then those along y.
  const auto addLines = [&](CellRange lines, CellRange cells, const Point2d& line_step, const Point2d& cell_step,
                            auto differs) {
    for (long line = lines.begin; line <= lines.end; ++line) {
      checkpoint();
      requireFewEdges();
      for (long cell = cells.begin; cell < cells.end;) {
        const long begin = cell;
        while (cell < cells.end && differs(line, cell)) ++cell;
        if (cell == begin) {
          ++cell;
          continue;
        }
        const Point2d base = corner + static_cast<double>(line) * line_step;
        edges_.push_back(
            {base + static_cast<double>(begin) * cell_step, base + static_cast<double>(cell) * cell_step, kGridSource});
      }
    }
  };
  addLines(rows, columns, across, along,
           [&](long row, long column) { return view.isBlocked(column, row - 1) != view.isBlocked(column, row); });
  addLines(columns, rows, along, across,
           [&](long column, long row) { return view.isBlocked(column - 1, row) != view.isBlocked(column, row); });
}

void LocalObstacles::cutEdge(std::size_t edge, double from, double to) {
  const ObstacleEdge whole = edges_[edge];
  const Point2d along = whole.end - whole.begin;
  if (from > 0.0) edges_.push_back({whole.begin, whole.begin + from * along, whole.source});
  if (to < 1.0) edges_.push_back({whole.begin + to * along, whole.end, whole.source});
  edges_[edge] = {whole.begin + from * along, whole.begin + to * along, whole.source};
}

std::optional<int> LocalObstacles::filledBy(const Point2d& local) const {
  if (region_->drivable() && isFilledBy(kDrivableSource, local)) return kDrivableSource;
  for (std::size_t i = 0; i < region_->nonDrivable().size(); ++i) {
    if (isFilledBy(static_cast<int>(i), local)) return static_cast<int>(i);
  }
  if (region_->grid() && isFilledBy(kGridSource, local)) return kGridSource;
  return std::nullopt;
}

bool LocalObstacles::isFilledBy(int source, const Point2d& local) const {
  const Point2d point = local + origin_;
  if (source == kDrivableSource) return !region_->drivable()->contains(point);
  if (source == kGridSource) return GridView(*region_->grid()).isBlocked(point);
  return region_->nonDrivable()[static_cast<std::size_t>(source)].contains(point);
}

bool LocalObstacles::isOutsideFilled() const {
  return region_->drivable() || (region_->grid() && region_->grid()->outside_is_blocked);
}

}  // namespace external_command
