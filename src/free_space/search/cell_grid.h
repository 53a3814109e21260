// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "external_command/core/pose.h"

namespace external_command {

/// The square cells that cover a box, numbered row by row from its lower left corner.
class CellGrid {
 public:
  /// @param cell_size   [m]; larger where the box would have more than `most_cells`, which bounds time and memory.
  CellGrid(const Point2d& corner, const Point2d& far_corner, double cell_size, double most_cells) : corner_(corner) {
    const Point2d size = far_corner - corner;
    cell_size_ = std::max(cell_size, std::sqrt(size.x() * size.y() / most_cells));
    columns_ = static_cast<long>(size.x() / cell_size_) + 1;
    rows_ = static_cast<long>(size.y() / cell_size_) + 1;
  }

  double cellSize() const { return cell_size_; }
  long count() const { return columns_ * rows_; }

  /// The cell at a point; -1 outside the grid.
  long at(const Point2d& point) const {
    const Point2d cell = (point - corner_) / cell_size_;
    const auto columns = static_cast<double>(columns_), rows = static_cast<double>(rows_);
    if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < columns && cell.y() < rows)) return -1;
    return static_cast<long>(cell.y()) * columns_ + static_cast<long>(cell.x());
  }

  Point2d centreOf(long cell) const { return cornerOf(cell) + Point2d::Constant(0.5 * cell_size_); }

  /// Calls `visit` with each of the up to 8 cells around `cell`, and whether the step there goes across.
  template <class Visit>
  void forEachAround(long cell, const Visit& visit) const {
    const long column = cell % columns_, row = cell / columns_;
    for (long dr = -1; dr <= 1; ++dr) {
      for (long dc = -1; dc <= 1; ++dc) {
        if ((dr == 0 && dc == 0) || !has(column + dc, row + dr)) continue;
        visit(cell + dr * columns_ + dc, dr != 0 && dc != 0);
      }
    }
  }

  /// Calls `visit` with each of the up to 4 cells beside `cell`, and the ends of the side between them.
  template <class Visit>
  void forEachBeside(long cell, const Visit& visit) const {
    const long column = cell % columns_, row = cell / columns_;
    const Point2d low = cornerOf(cell), x(cell_size_, 0.0), y(0.0, cell_size_);
    if (has(column - 1, row)) visit(cell - 1, low, low + y);
    if (has(column + 1, row)) visit(cell + 1, low + x, low + x + y);
    if (has(column, row - 1)) visit(cell - columns_, low, low + x);
    if (has(column, row + 1)) visit(cell + columns_, low + y, low + x + y);
  }

 private:
  bool has(long column, long row) const { return column >= 0 && row >= 0 && column < columns_ && row < rows_; }

  Point2d cornerOf(long cell) const {
    return corner_ + cell_size_ * Point2d(static_cast<double>(cell % columns_), static_cast<double>(cell / columns_));
  }

  Point2d corner_;
  double cell_size_;
  long columns_, rows_;
};

}  // namespace external_command
