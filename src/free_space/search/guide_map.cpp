// SPDX-License-Identifier: Apache-2.0
#include "guide_map.h"

#include <algorithm>
#include <array>
#include <utility>

#include "cell_costs.h"

namespace external_command {

namespace {

constexpr double kMaxCells = 600'000;  ///< more than the index has, so that cells agree
constexpr long kCellsPerLook = 1024;   ///< at the clock

/// By the room in a cell beyond what the vehicle needs.
struct Price {
  double room;  ///< from here up, beyond half the vehicle's width and the margin [m]
  std::uint16_t price;
};
constexpr std::array<Price, 4> kPrices{{{1.5, 4}, {0.7, 6}, {0.0, 10}, {-0.3, 40}}};
constexpr std::uint16_t kBlockedPrice = 60'000;  ///< some kilometres in the free: no detour costs as much
constexpr std::uint16_t kClosedPrice = 30'000;
constexpr double kClosedRadius = 2.0;  ///< [m]

}  // namespace

GuideMap::GuideMap(const FootprintIndex& index, const BoundingBox& area, std::function<bool()> stop)
    : grid_(index.snapped(area.min), area.max, index.cellSize(), kMaxCells), stop_(std::move(stop)) {
  prices_.assign(static_cast<std::size_t>(grid_.count()), kBlockedPrice);
  rooms_.assign(prices_.size(), 0.0F);
  const double needed = index.box().half_width + index.margin();
  for (long cell = 0; cell < grid_.count(); ++cell) {
    if (cell % kCellsPerLook == 0 && stop_()) return;
    const Point2d centre = grid_.centreOf(cell);
    if (!index.isWithinAxleBounds(centre.x(), centre.y())) continue;
    const double room = index.roomAt(centre);
    const auto price =
        std::find_if(kPrices.begin(), kPrices.end(), [&](const Price& p) { return room >= needed + p.room; });
    if (price != kPrices.end()) prices_[static_cast<std::size_t>(cell)] = price->price;
    rooms_[static_cast<std::size_t>(cell)] = static_cast<float>(room);
  }
}

std::vector<GuidePoint> GuideMap::way(const Point2d& from, const Point2d& to) const {
  const long first = grid_.at(from), last = grid_.at(to);
  if (first < 0 || last < 0) return {};
  long looked = 0;
  const std::vector<CellCost> costs = costsTo(
      grid_, prices_, last, [&](long cell) { return cell == first || (looked++ % kCellsPerLook == 0 && stop_()); });
  std::vector<GuidePoint> way;
  for (long cell = first;;) {
    way.push_back({grid_.centreOf(cell), static_cast<double>(rooms_[static_cast<std::size_t>(cell)])});
    if (cell == last) return way;
    const CellCost price = prices_[static_cast<std::size_t>(cell)];
    long best = cell;
    CellCost best_cost = kUnreachedCell;
    grid_.forEachAround(cell, [&](long next, bool is_across) {
      const CellCost cost = costs[static_cast<std::size_t>(next)];
      if (cost >= costs[static_cast<std::size_t>(cell)]) return;
      const CellCost through = cost + (is_across ? kAcrossStep : kStraightStep) * price;
      if (through < best_cost) best = next, best_cost = through;
    });
    if (best == cell) return {};
    cell = best;
  }
}

void GuideMap::close(const std::vector<GuidePoint>& way, std::size_t first, std::size_t last) {
  const auto isTighter = [](const GuidePoint& a, const GuidePoint& b) { return a.room < b.room; };
  const auto begin = way.begin() + static_cast<std::ptrdiff_t>(first);
  const Point2d at = std::min_element(begin, way.begin() + static_cast<std::ptrdiff_t>(last), isTighter)->at;
  for (long cell = 0; cell < grid_.count(); ++cell) {
    if ((grid_.centreOf(cell) - at).norm() < kClosedRadius) prices_[static_cast<std::size_t>(cell)] = kClosedPrice;
  }
}

}  // namespace external_command
