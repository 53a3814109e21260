// SPDX-License-Identifier: Apache-2.0
#include "profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace external_command {

namespace {

bool contains(const Part& part, const Point2d& point) {
  return std::all_of(part.begin(), part.end(), [&](const HalfPlane& side) { return side.contains(point); });
}

}  // namespace

Remains::Remains(const CoverageGrid& grid, double block, const Part& part) {
  const int side = std::max(1, static_cast<int>(block / grid.cell() + 1e-6));
  std::vector<int> counts(static_cast<std::size_t>(grid.columns() / side + 1));
  for (int first = 0; first < grid.rows(); first += side) {
    std::fill(counts.begin(), counts.end(), 0);
    for (int row = first; row < std::min(first + side, grid.rows()); ++row) {
      const std::uint8_t* cell = grid.row(row);
      for (int i = 0; i * side < grid.columns(); ++i) {
        const std::uint8_t* const end = grid.row(row) + std::min((i + 1) * side, grid.columns());
        for (; cell != end; ++cell) counts[static_cast<std::size_t>(i)] += (*cell & (kGoal | kSwept)) == kGoal;
      }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      const Point2d half = 0.5 * (side - 1) * Point2d(grid.cell(), grid.cell());
      const Spot spot{grid.centre(static_cast<int>(i) * side, first) + half, counts[i] * grid.cellArea()};
      if (!contains(part, spot.at)) continue;
      spots.push_back(spot);
      area += spot.area;
    }
  }
}

/// Of the coarse squares, those of one row are open at a time.
Remains::Remains(const Remains& fine, double block) : area(fine.area) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  long low = std::numeric_limits<long>::max(), high = std::numeric_limits<long>::lowest(), row = high;
  const auto columnOf = [&](const Spot& spot) { return std::lround(spot.at.x() / block); };
  for (const Spot& spot : fine.spots) low = std::min(low, columnOf(spot)), high = std::max(high, columnOf(spot));
  std::vector<std::size_t> seen;
  for (const Spot& spot : fine.spots) {
    const long at = std::lround(spot.at.y() / block);
    if (at != row) seen.assign(static_cast<std::size_t>(high - low + 1), kNone);
    row = at;
    std::size_t& place = seen[static_cast<std::size_t>(columnOf(spot) - low)];
    if (place == kNone) {
      place = spots.size();
      spots.push_back({Point2d(0.0, 0.0), 0.0});
    }
    Spot& sum = spots[place];
    sum.at += spot.area * spot.at;
    sum.area += spot.area;
  }
  for (Spot& spot : spots) spot.at /= spot.area;
}

Remains Remains::within(const Part& part) const {
  Remains result;
  for (const Spot& spot : spots) {
    if (!contains(part, spot.at)) continue;
    result.spots.push_back(spot);
    result.area += spot.area;
  }
  return result;
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
  if (low.x() > high.x()) {
    totals_.assign(1, 0.0);
    return;
  }
  corner_ = low.x() * ahead_ + low.y() * aside_;
  columns_ = static_cast<int>((high.x() - low.x()) / bin) + 1;
  rows_ = static_cast<int>((high.y() - low.y()) / bin) + 1;
  const auto stride = static_cast<std::size_t>(columns_);
  sums_.assign(stride * static_cast<std::size_t>(rows_ + 1), 0.0F);
  totals_.assign(static_cast<std::size_t>(rows_ + 1), 0.0);
  for (const Remains::Spot& spot : remains.spots) {
    const auto column = static_cast<std::size_t>((spot.at.dot(ahead_) - low.x()) / bin);
    const auto row = static_cast<std::size_t>((spot.at.dot(aside_) - low.y()) / bin);
    sums_[(row + 1) * stride + column] += static_cast<float>(spot.area);
    totals_[row + 1] += spot.area;
  }
  std::partial_sum(totals_.begin(), totals_.end(), totals_.begin());
  for (std::size_t i = stride; i < sums_.size(); ++i) sums_[i] += sums_[i - stride];
}

const float* Profile::below(int row) const {
  return &sums_[static_cast<std::size_t>(std::clamp(row, 0, rows_)) * static_cast<std::size_t>(columns_)];
}

}  // namespace external_command
