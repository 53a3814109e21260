// SPDX-License-Identifier: Apache-2.0
#include "guide_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace external_command {

namespace {

constexpr double kMaxCells = 600'000;  ///< bounds time and memory; more than the index has, so that cells agree

/// Prices of a step from cell to cell, by the room there beyond what the vehicle needs. A step straight on is 5 times
/// that, one across 7 times.
struct Price {
  double room;  ///< from here up, beyond half the vehicle's width and the margin [m]
  std::uint16_t price;
};
constexpr std::array<Price, 4> kPrices{{{1.5, 4}, {0.7, 6}, {0.0, 10}, {-0.3, 40}}};
constexpr std::uint16_t kBlockedPrice = 60'000;  ///< some kilometres in the free: no detour costs as much
constexpr std::uint16_t kClosedPrice = 30'000;
constexpr double kClosedRadius = 2.0;  ///< [m]
constexpr std::uint32_t kStraight = 5, kAcross = 7;
constexpr std::uint64_t kUnreached = std::numeric_limits<std::uint64_t>::max();

}  // namespace

GuideMap::GuideMap(const FootprintIndex& index, const BoundingBox& area)
    : corner_(index.snapped(area.min)), cell_size_(index.cellSize()) {
  const Point2d size = area.max - corner_;
  cell_size_ = std::max(cell_size_, std::sqrt(size.x() * size.y() / kMaxCells));
  columns_ = static_cast<long>(size.x() / cell_size_) + 1;
  rows_ = static_cast<long>(size.y() / cell_size_) + 1;
  prices_.reserve(static_cast<std::size_t>(columns_ * rows_));
  rooms_.reserve(prices_.capacity());
  const double needed = index.box().half_width + index.margin();
  for (long cell = 0; cell < columns_ * rows_; ++cell) {
    const Point2d centre = centreOf(cell);
    const double room = index.isWithinAxleBounds(centre.x(), centre.y()) ? index.roomAt(centre) : 0.0;
    const auto price =
        std::find_if(kPrices.begin(), kPrices.end(), [&](const Price& p) { return room >= needed + p.room; });
    prices_.push_back(price == kPrices.end() ? kBlockedPrice : price->price);
    rooms_.push_back(static_cast<float>(room));
  }
}

long GuideMap::cellAt(const Point2d& point) const {
  const Point2d cell = (point - corner_) / cell_size_;
  const auto columns = static_cast<double>(columns_), rows = static_cast<double>(rows_);
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < columns && cell.y() < rows)) return -1;
  return static_cast<long>(cell.y()) * columns_ + static_cast<long>(cell.x());
}

Point2d GuideMap::centreOf(long cell) const {
  return corner_ +
         cell_size_ * Point2d(static_cast<double>(cell % columns_) + 0.5, static_cast<double>(cell / columns_) + 0.5);
}

/// Dijkstra's search with a bucket for each cost that a step in the free leads to, and a heap for the few dearer ones.
std::vector<GuideMap::Cost> GuideMap::costsTo(long target, long from) const {
  using Entry = std::pair<Cost, long>;
  std::vector<Cost> costs(prices_.size(), kUnreached);
  std::vector<std::vector<long>> buckets(kAcross * kPrices.back().price + 1);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> dear;
  const auto add = [&](Cost now, Cost cost, long cell) {
    costs[static_cast<std::size_t>(cell)] = cost;
    if (cost - now >= buckets.size()) {
      dear.emplace(cost, cell);
    } else {
      buckets[cost % buckets.size()].push_back(cell);
    }
    return cost - now < buckets.size() ? 1U : 0U;
  };
  std::size_t waiting = add(0, 0, target);
  for (Cost now = 0; waiting > 0 || !dear.empty(); ++now) {
    if (waiting == 0) now = dear.top().first;
    std::vector<long>& bucket = buckets[now % buckets.size()];
    for (; !dear.empty() && dear.top().first == now; dear.pop(), ++waiting) bucket.push_back(dear.top().second);
    for (std::size_t b = 0; b < bucket.size(); ++b) {
      const long cell = bucket[b];
      --waiting;
      if (costs[static_cast<std::size_t>(cell)] < now) continue;
      if (cell == from) return costs;
      const long column = cell % columns_, row = cell / columns_;
      for (long dr = -1; dr <= 1; ++dr) {
        for (long dc = -1; dc <= 1; ++dc) {
          if (column + dc < 0 || row + dr < 0 || column + dc >= columns_ || row + dr >= rows_) continue;
          const long next = cell + dr * columns_ + dc;
          const Cost price = prices_[static_cast<std::size_t>(next)];
          const Cost through = now + (dr != 0 && dc != 0 ? kAcross : kStraight) * price;
          if (through < costs[static_cast<std::size_t>(next)]) waiting += add(now, through, next);
        }
      }
    }
    bucket.clear();
  }
  return costs;
}

std::vector<GuidePoint> GuideMap::way(const Point2d& from, const Point2d& to) const {
  const long first = cellAt(from), last = cellAt(to);
  if (first < 0 || last < 0) return {};
  const std::vector<Cost> costs = costsTo(last, first);
  std::vector<GuidePoint> way;
  for (long cell = first;;) {
    way.push_back({centreOf(cell), static_cast<double>(rooms_[static_cast<std::size_t>(cell)])});
    if (cell == last) return way;
    const long column = cell % columns_, row = cell / columns_;
    long best = cell;
    Cost best_cost = kUnreached;
    for (long dr = -1; dr <= 1; ++dr) {
      for (long dc = -1; dc <= 1; ++dc) {
        if (column + dc < 0 || row + dr < 0 || column + dc >= columns_ || row + dr >= rows_) continue;
        const long next = cell + dr * columns_ + dc;
        const Cost cost = costs[static_cast<std::size_t>(next)];
        if (next == cell || cost >= costs[static_cast<std::size_t>(cell)]) continue;
        const Cost step = (dr != 0 && dc != 0 ? kAcross : kStraight) * prices_[static_cast<std::size_t>(cell)];
        if (cost + step < best_cost) best = next, best_cost = cost + step;
      }
    }
    if (best == cell) return {};
    cell = best;
  }
}

void GuideMap::close(const std::vector<GuidePoint>& way, std::size_t first, std::size_t last) {
  const auto isTighter = [](const GuidePoint& a, const GuidePoint& b) { return a.room < b.room; };
  const auto begin = way.begin() + static_cast<std::ptrdiff_t>(first);
  const Point2d at = std::min_element(begin, way.begin() + static_cast<std::ptrdiff_t>(last), isTighter)->at;
  for (long cell = 0; cell < columns_ * rows_; ++cell) {
    if ((centreOf(cell) - at).norm() < kClosedRadius) prices_[static_cast<std::size_t>(cell)] = kClosedPrice;
  }
}

}  // namespace external_command
