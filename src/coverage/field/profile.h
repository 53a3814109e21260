// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "grid.h"

namespace external_command {

/// One side of a straight line.
struct HalfPlane {
  Point2d inward;  ///< of length 1
  double least;    ///< of a point in it, along `inward` [m]

  bool contains(const Point2d& point) const { return point.dot(inward) >= least; }
};

/// What lies in all of them; without any, everything.
using Part = std::vector<HalfPlane>;

/// What is left to sweep, as points that stand for an area each.
struct Remains {
  /// @param block  side of the squares that are taken together [m].
  Remains(const CoverageGrid& grid, double block, const Part& part = {});

  /// The same, coarser. @param fine  of a grid, so row by row.
  Remains(const Remains& fine, double block);

  Remains within(const Part& part) const;

  struct Spot {
    Point2d at;
    double area;  ///< [m^2]
  };
  std::vector<Spot> spots;
  double area = 0.0;  ///< of all [m^2]

 private:
  Remains() = default;
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

  /// Running sums over the rows: the area [m^2] left in rows `first` ... `last - 1` of column i is
  /// below(last)[i] - below(first)[i]. Rows beyond the ends are empty.
  const float* below(int row) const;

  /// Area [m^2] left in rows `first` ... `last - 1`.
  double areaOf(int first, int last) const { return areaBelow(last) - areaBelow(first); }

  /// The point at a distance [m] along and across from the corner of bin (0, 0).
  Point2d point(double along, double across) const { return corner_ + along * ahead_ + across * aside_; }

 private:
  double areaBelow(int row) const { return totals_[static_cast<std::size_t>(std::clamp(row, 0, rows_))]; }

  double heading_;
  double bin_;
  Point2d ahead_;
  Point2d aside_;
  Point2d corner_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> sums_;
  std::vector<double> totals_;  ///< of all columns, running over the rows
};

}  // namespace external_command
