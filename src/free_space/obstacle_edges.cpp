// SPDX-License-Identifier: Apache-2.0
#include "obstacle_edges.h"

#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr std::size_t kMaxEdges = 2'000'000;  ///< bounds the memory

/// Reads cells by index; beyond the grid everything is unknown.
class GridView {
 public:
  explicit GridView(const OccupancyGrid& grid)
      : grid_(grid), width_(static_cast<long>(grid.width)), height_(static_cast<long>(grid.height)) {}

  bool isBlocked(long column, long row) const {
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return grid_.unknown_is_blocked;
    const int value = grid_.cells[static_cast<std::size_t>(row * width_ + column)];
    return value < 0 ? grid_.unknown_is_blocked : value >= grid_.blocked_from;
  }

  bool isBlocked(const Point2d& point) const {
    const Pose2d seen = relativeTo(grid_.origin, {point.x(), point.y(), 0.0});
    const double column = std::floor(seen.x / grid_.resolution), row = std::floor(seen.y / grid_.resolution);
    if (std::abs(column) > 1e9 || std::abs(row) > 1e9) return grid_.unknown_is_blocked;
    return isBlocked(static_cast<long>(column), static_cast<long>(row));
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
  if (edges_.size() <= kMaxEdges) return;
  throw InvalidRequest(text("the borders of the region's obstacles have more than ", kMaxEdges,
                            " edges; give a smaller region or a coarser grid"));
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
  // Borders between a free and a blocked cell, joined to runs: first the lines along x, then those along y.
  const auto addLines = [&](long lines, long cells, const Point2d& line_step, const Point2d& cell_step, auto differs) {
    for (long line = 0; line <= lines; ++line) {
      checkpoint();
      requireFewEdges();
      for (long cell = 0; cell < cells;) {
        const long begin = cell;
        while (cell < cells && differs(line, cell)) ++cell;
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
  addLines(grid.height, grid.width, across, along,
           [&](long row, long column) { return view.isBlocked(column, row - 1) != view.isBlocked(column, row); });
  addLines(grid.width, grid.height, along, across,
           [&](long column, long row) { return view.isBlocked(column - 1, row) != view.isBlocked(column, row); });
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
  return region_->drivable() || (region_->grid() && region_->grid()->unknown_is_blocked);
}

}  // namespace external_command
