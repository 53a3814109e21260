// SPDX-License-Identifier: Apache-2.0
#include "distance_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace external_command {

namespace {

constexpr double kMaxCells = 250'000;  // bounds time and memory
constexpr float kUnreached = std::numeric_limits<float>::infinity();

}  // namespace

DistanceMap::DistanceMap(const FootprintIndex& index, const BoundingBox& area, const Pose2d& target)
    : corner_(index.snapped(area.min)), cell_size_(index.cellSize()) {
  const Point2d size = area.max - corner_;
  cell_size_ = std::max(cell_size_, std::sqrt(size.x() * size.y() / kMaxCells));
  columns_ = static_cast<long>(size.x() / cell_size_) + 1;
  rows_ = static_cast<long>(size.y() / cell_size_) + 1;
  distances_.assign(static_cast<std::size_t>(columns_ * rows_), kUnreached);
  flood(index, target);
}

long DistanceMap::cellAt(double x, double y) const {
  const double column = (x - corner_.x()) / cell_size_, row = (y - corner_.y()) / cell_size_;
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_))) {
    return -1;
  }
  return static_cast<long>(row) * columns_ + static_cast<long>(column);
}

double DistanceMap::at(double x, double y) const {
  const long cell = cellAt(x, y);
  return cell < 0 ? kUnreached : static_cast<double>(distances_[static_cast<std::size_t>(cell)]);
}

/// Dijkstra's search with one bucket per distance in fifths of a cell: 5 straight on, 7 across.
void DistanceMap::flood(const FootprintIndex& index, const Pose2d& target) {
  const long first = cellAt(target.x, target.y);
  if (first < 0) return;
  constexpr std::uint32_t kStraight = 5, kAcross = 7, kFar = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> steps(distances_.size(), kFar);
  for (long cell = 0; cell < columns_ * rows_; ++cell) {
    const double x = corner_.x() + (static_cast<double>(cell % columns_) + 0.5) * cell_size_;
    const double y = corner_.y() + (static_cast<double>(cell / columns_) + 0.5) * cell_size_;
    if (!index.axleMayBeWithin(x, y, cell_size_ * M_SQRT1_2)) steps[static_cast<std::size_t>(cell)] = 0;
  }
  std::array<std::vector<long>, kAcross + 1> buckets;
  steps[static_cast<std::size_t>(first)] = 0;
  distances_[static_cast<std::size_t>(first)] = 0.0F;
  buckets[0].push_back(first);
  std::size_t waiting = 1;
  for (std::uint32_t now = 0; waiting > 0; ++now) {
    std::vector<long>& bucket = buckets[now % buckets.size()];
    for (std::size_t b = 0; b < bucket.size(); ++b) {
      const long cell = bucket[b];
      --waiting;
      if (steps[static_cast<std::size_t>(cell)] < now) continue;
      distances_[static_cast<std::size_t>(cell)] = static_cast<float>(now * cell_size_ / kStraight);
      const long column = cell % columns_, row = cell / columns_;
      for (long dr = -1; dr <= 1; ++dr) {
        for (long dc = -1; dc <= 1; ++dc) {
          if (column + dc < 0 || row + dr < 0 || column + dc >= columns_ || row + dr >= rows_) continue;
          const auto next = static_cast<std::size_t>(cell + dr * columns_ + dc);
          const std::uint32_t through = now + (dr != 0 && dc != 0 ? kAcross : kStraight);
          if (through >= steps[next]) continue;
          steps[next] = through;
          buckets[through % buckets.size()].push_back(static_cast<long>(next));
          ++waiting;
        }
      }
    }
    bucket.clear();
  }
}

}  // namespace external_command
