// SPDX-License-Identifier: Apache-2.0
#include "distance_map.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "cell_costs.h"

namespace external_command {

namespace {

constexpr double kMaxCells = 250'000;
constexpr float kUnreached = std::numeric_limits<float>::infinity();

}  // namespace

DistanceMap::DistanceMap(const FootprintIndex& index, const BoundingBox& area, const Pose2d& target)
    : grid_(index.snapped(area.min), area.max, index.cellSize(), kMaxCells) {
  distances_.assign(static_cast<std::size_t>(grid_.count()), kUnreached);
  const long last = grid_.at(target.position());
  if (last < 0) return;
  std::vector<std::uint16_t> prices;
  prices.reserve(distances_.size());
  for (long cell = 0; cell < grid_.count(); ++cell) {
    const Point2d centre = grid_.centreOf(cell);
    prices.push_back(index.axleMayBeWithin(centre.x(), centre.y(), grid_.cellSize() * M_SQRT1_2) ? 1 : 0);
  }
  const std::vector<CellCost> costs = costsTo(grid_, prices, last, [](long /*cell*/) { return false; });
  for (std::size_t cell = 0; cell < costs.size(); ++cell) {
    if (costs[cell] == kUnreachedCell) continue;
    distances_[cell] = static_cast<float>(static_cast<double>(costs[cell]) * grid_.cellSize() / kStraightStep);
  }
}

double DistanceMap::at(double x, double y) const {
  const long cell = grid_.at({x, y});
  return cell < 0 ? kUnreached : static_cast<double>(distances_[static_cast<std::size_t>(cell)]);
}

}  // namespace external_command
