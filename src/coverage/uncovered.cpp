// SPDX-License-Identifier: Apache-2.0
#include "uncovered.h"

#include <algorithm>
#include <utility>

namespace external_command {

namespace {

constexpr double kMinArea = 0.5;  // smaller parts are specks between swaths [m^2]

struct Part {
  int low_column, high_column, low_row, high_row;
  std::size_t cells = 0;
};

bool isOpen(const CoverageGrid& grid, int column, int row) {
  const std::uint8_t cell = grid.at(column, row);
  return (cell & kGoal) != 0 && (cell & kSwept) == 0;
}

/// Visits the cells connected to (column, row).
Part floodFrom(const CoverageGrid& grid, int column, int row, std::vector<bool>* seen) {
  const auto index = [&](int c, int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.columns()) + static_cast<std::size_t>(c);
  };
  Part part{column, column, row, row};
  std::vector<std::pair<int, int>> open = {{column, row}};
  (*seen)[index(column, row)] = true;
  while (!open.empty()) {
    const auto [c, r] = open.back();
    open.pop_back();
    ++part.cells;
    part.low_column = std::min(part.low_column, c);
    part.high_column = std::max(part.high_column, c);
    part.low_row = std::min(part.low_row, r);
    part.high_row = std::max(part.high_row, r);
    for (const auto& [dc, dr] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      const int nc = c + dc, nr = r + dr;
      if (nc < 0 || nr < 0 || nc >= grid.columns() || nr >= grid.rows()) continue;
      if ((*seen)[index(nc, nr)] || !isOpen(grid, nc, nr)) continue;
      (*seen)[index(nc, nr)] = true;
      open.emplace_back(nc, nr);
    }
  }
  return part;
}

}  // namespace

std::vector<std::vector<Point2d>> uncoveredParts(const CoverageGrid& grid, const Point2d& origin) {
  std::vector<std::vector<Point2d>> parts;
  std::vector<bool> seen(static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()), false);
  const double half = grid.cell() / 2.0;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const std::size_t index =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) + static_cast<std::size_t>(column);
      if (seen[index] || !isOpen(grid, column, row)) continue;
      const Part part = floodFrom(grid, column, row, &seen);
      if (static_cast<double>(part.cells) * grid.cellArea() < kMinArea) continue;
      const Point2d low = origin + grid.centre(part.low_column, part.low_row) - Point2d(half, half);
      const Point2d high = origin + grid.centre(part.high_column, part.high_row) + Point2d(half, half);
      parts.push_back({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
    }
  }
  return parts;
}

}  // namespace external_command
