// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "footprint_index.h"

namespace external_command {

bool FootprintIndex::axleMayBeWithin(double x, double y, double radius) const {
  if (x < axle_bounds_.min.x() - radius || x > axle_bounds_.max.x() + radius) return false;
  if (y < axle_bounds_.min.y() - radius || y > axle_bounds_.max.y() + radius) return false;
  const long cell = cellAt(x, y);
  if (cell < 0) return outside_is_free_;
  const auto at = static_cast<std::size_t>(cell);
  const double slack = radius + (cellCentre(cell % columns_, cell / columns_) - Point2d(x, y)).norm();
  if (states_[at] == State::kFilled) return near_[at] <= slack;
  if (near_[at] + slack >= axleDisc()) return true;
  return !margins_.empty() &&
         roomWithin(cell, cellCentre(cell % columns_, cell / columns_), axleDisc()) + slack >= axleDisc();
}

/// axleRoom() by the edges that are listed.
double FootprintIndex::roomWithin(long cell, const Point2d& point, double limit) const {
  double room = limit;
  for (const std::uint32_t number : groupsNear(cell)) {
    const EdgeGroup& group = groups_[number];
    if (group.core.distanceFrom(point) - group.radius >= room) continue;
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      room = std::min(room, edges_[i].distanceFrom(point) + easedBy(i));
    }
  }
  return room;
}

double FootprintIndex::axleRoom(const Point2d& point, double limit) const {
  const long cell = cellAt(point.x(), point.y());
  if (cell < 0) return outside_is_free_ ? limit : 0.0;
  const auto at = static_cast<std::size_t>(cell);
  const double near = static_cast<double>(near_[at]);
  if (near > cell_reach_ && states_[at] == State::kFilled) return cell_reach_ - near;
  if (near - cell_reach_ >= limit) return limit;
  return roomWithin(cell, point, limit);
}

double FootprintIndex::roomAt(const Point2d& point) const {
  const long cell = cellAt(point.x(), point.y());
  if (cell < 0) return outside_is_free_ ? std::numeric_limits<double>::infinity() : 0.0;
  const auto at = static_cast<std::size_t>(cell);
  return states_[at] == State::kFree ? static_cast<double>(near_[at]) : 0.0;
}

double FootprintIndex::roomBetweenCells(const Point2d& point) const {
  const Point2d low = cellCentre(0, 0);
  const Point2d at = (point - low) / cell_size_;
  const double column = std::floor(at.x()), row = std::floor(at.y());
  if (!(column >= 0.0 && row >= 0.0 && column + 1.0 < static_cast<double>(columns_) &&
        row + 1.0 < static_cast<double>(rows_))) {
    return roomAt(point);
  }
  const auto here = static_cast<std::size_t>(static_cast<long>(row) * columns_ + static_cast<long>(column));
  const auto room = [this](std::size_t cell) {
    return states_[cell] == State::kFree ? static_cast<double>(near_[cell]) : 0.0;
  };
  const double x = at.x() - column, y = at.y() - row;
  const auto above = here + static_cast<std::size_t>(columns_);
  return (1.0 - y) * ((1.0 - x) * room(here) + x * room(here + 1)) +
         y * ((1.0 - x) * room(above) + x * room(above + 1));
}

}  // namespace external_command
