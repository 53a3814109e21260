// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "grid.h"

namespace external_command {

/// What is left to sweep, as points that stand for an area each.
struct Remains {
  /// @param block  side of the squares that are taken together [m].
  Remains(const CoverageGrid& grid, double block);

  /// The same, coarser.
  Remains(const Remains& fine, double block);

  struct Spot {
    Point2d at;
    double area;  ///< [m^2]
  };
  std::vector<Spot> spots;
  double area = 0.0;  ///< of all [m^2]
};

/// What is left to sweep, seen along one direction: the area in bins, along it and across.
class Profile {
 public:
  /// @param bin  side of a bin [m].
  Profile(const Remains& remains, double heading, double bin);

  double heading() const { return heading_; }
  double bin() const { return bin_; }
  int columns() const { return columns_; }  ///< along
  int rows() const { return rows_; }        ///< across

  /// Area [m^2] left in the bins `row` ... `row + count - 1` of a column.
  double left(int column, int row, int count) const;

  /// The point at a distance [m] along and across from the corner of bin (0, 0).
  Point2d point(double along, double across) const { return corner_ + along * ahead_ + across * aside_; }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_ + 1) + static_cast<std::size_t>(row);
  }

  double heading_;
  double bin_;
  Point2d ahead_;
  Point2d aside_;
  Point2d corner_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> sums_;  ///< running sums over the rows, so that left() is one difference
};

}  // namespace external_command
