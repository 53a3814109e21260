// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coverage/path/curve.h"
#include "external_command/core/polygon.h"
#include "geometry.h"

namespace external_command {

/// What is known of a cell, as bits.
enum CellFlag : std::uint8_t {
  kFree = 1,       ///< within the area
  kGoal = 2,       ///< within what the vehicle can reach
  kSwept = 4,      ///< worked on
  kOpen = 8,       ///< the vehicle's centre line can be there
  kOwn = 16,       ///< nominally swept by the lap in hand: what it leaves can still be swept by others
  kInner = 32,     ///< left to later laps and swaths
  kMarked = 64,    ///< for the moment
  kPassable = 128  ///< the vehicle's centre line could be there but for small holes
};

/// The area as fine cells; a cell is what its centre is. Copyable: each plan that is tried has its own.
class CoverageGrid {
 public:
  CoverageGrid(const BoundingBox& box, double cell);

  double cell() const { return cell_; }
  double cellArea() const { return cell_ * cell_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::uint8_t at(int column, int row) const { return cells_[index(column, row)]; }
  const std::uint8_t* row(int row) const { return &cells_[index(0, row)]; }
  Point2d centre(int column, int row) const { return corner_ + cell_ * Point2d(column + 0.5, row + 0.5); }

  int columnOf(double x) const { return static_cast<int>(std::floor((x - corner_.x()) / cell_)); }
  int rowOf(double y) const { return static_cast<int>(std::floor((y - corner_.y()) / cell_)); }

  /// Flags of the cell that holds the point; 0 beyond the grid.
  std::uint8_t at(const Point2d& point) const {
    const int column = columnOf(point.x()), row = rowOf(point.y());
    return column < 0 || row < 0 || column >= columns_ || row >= rows_ ? std::uint8_t{0} : at(column, row);
  }

  std::size_t size() const { return cells_.size(); }
  std::uint8_t* data() { return cells_.data(); }

  void set(const shapes::Shapes& within, std::uint8_t flag);
  void clear(std::uint8_t flag);

  /// Marks what work along `curve` sweeps. @return the area of the goal that was not swept before [m^2].
  double sweep(const Curve& curve, double width);

  /// The area of the goal [m^2] that work along all of `curves` would add, without the cells that are kInner; those
  /// that are kOwn count `own_share`. Uses kMarked, and clears it again.
  double gain(const std::vector<Curve>& curves, double width, double own_share);

  /// Area [m^2] of the cells that have all of `with` and none of `without`.
  double area(std::uint8_t with, std::uint8_t without) const;

  /// Calls `visit(first, last)` for each run of cells, as pointers into a row, whose centres lie in the convex `quad`.
  template <class Cells, class Visit>
  static void visitRuns(Cells& grid, const std::array<Point2d, 4>& quad, const Visit& visit);

 private:
  /// The rows of centres that an edge crosses; lengths in cells.
  struct RowEdge {
    int first;
    int last;
    Point2d from;
    Point2d along;
  };

  void addEdges(const shapes::Ring& ring, std::vector<RowEdge>* edges) const;

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  Point2d corner_;
  double cell_;
  int columns_;
  int rows_;
  std::vector<std::uint8_t> cells_;
};

template <class Cells, class Visit>
void CoverageGrid::visitRuns(Cells& grid, const std::array<Point2d, 4>& quad, const Visit& visit) {
  std::array<Point2d, 4> q;  // in cells, so that the centre of cell (i, j) is at (i, j)
  double low = 1e18, high = -1e18;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = (quad[i] - grid.corner_) / grid.cell_ - Point2d(0.5, 0.5);
    low = std::min(low, q[i].y());
    high = std::max(high, q[i].y());
  }
  const int first_row = std::max(0, static_cast<int>(std::ceil(low)));
  const int last_row = std::min(grid.rows_ - 1, static_cast<int>(std::floor(high)));
  for (int row = first_row; row <= last_row; ++row) {
    double left = 1e18, right = -1e18;
    for (std::size_t i = 0, j = 3; i < 4; j = i++) {
      if ((q[i].y() > row) == (q[j].y() > row)) continue;
      const double x = q[i].x() + (row - q[i].y()) * (q[j].x() - q[i].x()) / (q[j].y() - q[i].y());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (left > right) continue;
    const int begin = std::max(0, static_cast<int>(std::ceil(left)));
    const int end = std::min(grid.columns_ - 1, static_cast<int>(std::floor(right)));
    if (begin <= end) visit(&grid.cells_[grid.index(begin, row)], &grid.cells_[grid.index(end, row)] + 1);
  }
}

}  // namespace external_command
