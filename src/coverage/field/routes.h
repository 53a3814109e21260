// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "field.h"

namespace external_command {

/// Roughly how far it is from place to place within the area, for a point that stays half a vehicle's width away from
/// everything: straight where nothing is between, else along a coarse grid. Remembers what it has worked out.
class Routes {
 public:
  explicit Routes(const Field& field);

  double distance(const Point2d& from, const Point2d& to);

  /// Whether the vehicle's centre line can be there.
  bool isOpen(const Point2d& point) const { return (fine_.at(point) & kMarked) != 0; }

  /// Whether the straight line keeps to the places where the vehicle's centre line can be.
  bool isStraightFree(const Point2d& from, const Point2d& to) const;

 private:
  int cellAt(const Point2d& point) const;
  int nearestOpen(const Point2d& point) const;
  const std::vector<float>& distancesFrom(int cell);

  CoverageGrid fine_;  ///< kMarked where the centre line can be
  BoundingBox box_;
  double cell_;
  int columns_;
  int rows_;
  std::vector<char> open_;
  std::map<int, std::vector<float>> known_;  ///< distances from a cell to all
};

}  // namespace external_command
