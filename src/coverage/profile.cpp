// SPDX-License-Identifier: Apache-2.0
#include "profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace external_command {

Remains::Remains(const CoverageGrid& grid, double block) {
  const int side = std::max(1, static_cast<int>(std::lround(block / grid.cell())));
  std::vector<int> counts(static_cast<std::size_t>(grid.columns() / side + 1));
  for (int first = 0; first < grid.rows(); first += side) {
    std::fill(counts.begin(), counts.end(), 0);
    for (int row = first; row < std::min(first + side, grid.rows()); ++row) {
      for (int column = 0; column < grid.columns(); ++column) {
        counts[static_cast<std::size_t>(column / side)] += (grid.at(column, row) & (kGoal | kSwept)) == kGoal;
      }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      const Point2d half = 0.5 * (side - 1) * Point2d(grid.cell(), grid.cell());
      spots.push_back({grid.centre(static_cast<int>(i) * side, first) + half, counts[i] * grid.cellArea()});
      area += spots.back().area;
    }
  }
}

Remains::Remains(const Remains& fine, double block) : area(fine.area) {
  std::unordered_map<long, std::size_t> seen;
  for (const Spot& spot : fine.spots) {
    const long column = std::lround(spot.at.x() / block), row = std::lround(spot.at.y() / block);
    const auto [entry, is_new] = seen.try_emplace(row * 1000003L + column, spots.size());
    if (is_new) spots.push_back({Point2d(0.0, 0.0), 0.0});
    Spot& sum = spots[entry->second];
    sum.at += spot.area * spot.at;
    sum.area += spot.area;
  }
  for (Spot& spot : spots) spot.at /= spot.area;
}

Profile::Profile(const Remains& remains, double heading, double bin)
    : heading_(heading), bin_(bin), ahead_(unitVector(heading)), aside_(-ahead_.y(), ahead_.x()) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Point2d low(kFar, kFar), high(-kFar, -kFar);
  for (const Remains::Spot& spot : remains.spots) {
    const Point2d turned(spot.at.dot(ahead_), spot.at.dot(aside_));
    low = low.cwiseMin(turned);
    high = high.cwiseMax(turned);
  }
  if (low.x() > high.x()) return;
  corner_ = low.x() * ahead_ + low.y() * aside_;
  columns_ = static_cast<int>((high.x() - low.x()) / bin) + 1;
  rows_ = static_cast<int>((high.y() - low.y()) / bin) + 1;
  sums_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_ + 1), 0.0F);
  for (const Remains::Spot& spot : remains.spots) {
    const int column = static_cast<int>((spot.at.dot(ahead_) - low.x()) / bin);
    const int row = static_cast<int>((spot.at.dot(aside_) - low.y()) / bin);
    sums_[index(column, row + 1)] += static_cast<float>(spot.area);
  }
  for (int column = 0; column < columns_; ++column) {
    for (int row = 0; row < rows_; ++row) sums_[index(column, row + 1)] += sums_[index(column, row)];
  }
}

double Profile::left(int column, int row, int count) const {
  const int first = std::clamp(row, 0, rows_), last = std::clamp(row + count, 0, rows_);
  return static_cast<double>(sums_[index(column, last)] - sums_[index(column, first)]);
}

}  // namespace external_command
