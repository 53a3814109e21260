// SPDX-License-Identifier: Apache-2.0
#include "uncovered.h"

namespace external_command {

namespace {

constexpr double kMinArea = 0.5;  // smaller parts are specks between swaths [m^2]

bool isOpen(const CoverageGrid& grid, int column, int row) {
  const std::uint8_t cell = grid.at(column, row);
  return (cell & kGoal) != 0 && (cell & kSwept) == 0;
}

/// The cells connected to (column, row).
UnsweptPart floodFrom(const CoverageGrid& grid, int column, int row, std::vector<bool>* seen) {
  const auto index = [&](int c, int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.columns()) + static_cast<std::size_t>(c);
  };
  UnsweptPart part = {{column, row}};
  (*seen)[index(column, row)] = true;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto [c, r] = part[i];
    for (const auto& [dc, dr] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      const int nc = c + dc, nr = r + dr;
      if (nc < 0 || nr < 0 || nc >= grid.columns() || nr >= grid.rows()) continue;
      if ((*seen)[index(nc, nr)] || !isOpen(grid, nc, nr)) continue;
      (*seen)[index(nc, nr)] = true;
      part.emplace_back(nc, nr);
    }
  }
  return part;
}

}  // namespace

std::vector<UnsweptPart> unsweptParts(const CoverageGrid& grid, double least) {
  std::vector<UnsweptPart> parts;
  std::vector<bool> seen(static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()), false);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const std::size_t index =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) + static_cast<std::size_t>(column);
      if (seen[index] || !isOpen(grid, column, row)) continue;
      UnsweptPart part = floodFrom(grid, column, row, &seen);
      if (static_cast<double>(part.size()) * grid.cellArea() >= least) parts.push_back(std::move(part));
    }
  }
  return parts;
}

std::vector<std::vector<Point2d>> uncoveredParts(const CoverageGrid& grid, const Point2d& origin) {
  std::vector<std::vector<Point2d>> boxes;
  const Point2d half(grid.cell() / 2.0, grid.cell() / 2.0);
  for (const UnsweptPart& part : unsweptParts(grid, kMinArea)) {
    Point2d low = grid.centre(part[0].first, part[0].second), high = low;
    for (const auto& [column, row] : part) {
      low = low.cwiseMin(grid.centre(column, row));
      high = high.cwiseMax(grid.centre(column, row));
    }
    low += origin - half;
    high += origin + half;
    boxes.push_back({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  }
  return boxes;
}

}  // namespace external_command
