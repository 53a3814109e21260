// SPDX-License-Identifier: Apache-2.0
#include "uncovered.h"

namespace external_command {

namespace {

constexpr double kMinArea = 0.5;  // smaller parts are specks between swaths [m^2]

bool isOpen(const CoverageGrid& grid, int column, int row) {
  const std::uint8_t cell = grid.at(column, row);
  return (cell & kGoal) != 0 && (cell & kSwept) == 0;
}

/// Finds parts, each once.
class Flood {
 public:
  Flood(const CoverageGrid& grid, double least)
      : grid_(grid),
        least_(least),
        seen_(static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()), false) {}

  void from(int column, int row) {
    if (!isNew(column, row)) return;
    UnsweptPart part = {{column, row}};
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto [c, r] = part[i];
      for (const auto& [nc, nr] :
           {std::pair(c + 1, r), std::pair(c - 1, r), std::pair(c, r + 1), std::pair(c, r - 1)}) {
        if (nc < 0 || nr < 0 || nc >= grid_.columns() || nr >= grid_.rows() || !isNew(nc, nr)) continue;
        part.emplace_back(nc, nr);
      }
    }
    if (static_cast<double>(part.size()) * grid_.cellArea() >= least_) parts_.push_back(std::move(part));
  }

  std::vector<UnsweptPart> parts() { return std::move(parts_); }

 private:
  /// Whether the cell is unswept and not seen before; it is seen then.
  bool isNew(int column, int row) {
    const std::size_t index =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns()) + static_cast<std::size_t>(column);
    if (seen_[index] || !isOpen(grid_, column, row)) return false;
    seen_[index] = true;
    return true;
  }

  const CoverageGrid& grid_;
  double least_;
  std::vector<bool> seen_;
  std::vector<UnsweptPart> parts_;
};

}  // namespace

std::vector<UnsweptPart> unsweptParts(const CoverageGrid& grid, double least) {
  Flood flood(grid, least);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) flood.from(column, row);
  }
  return flood.parts();
}

std::vector<UnsweptPart> unsweptParts(const CoverageGrid& grid, double least, const UnsweptPart& cells) {
  Flood flood(grid, least);
  for (const auto& [column, row] : cells) flood.from(column, row);
  return flood.parts();
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
