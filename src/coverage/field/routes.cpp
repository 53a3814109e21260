// SPDX-License-Identifier: Apache-2.0
#include "routes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace external_command {

namespace {

constexpr double kCoarseCells = 3000.0;
constexpr double kFineCells = 400e3;
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr double kUnreachable = 1e5;  // [m]

CoverageGrid fineGrid(const Field& field) {
  const BoundingBox& box = field.region().drivable()->box();
  const Point2d size = box.max - box.min;
  CoverageGrid grid(box, std::max(0.2, std::sqrt(size.x() * size.y() / kFineCells)));
  grid.set(grown(field.free(), -0.95 * field.vehicle().width / 2.0, field.checkpoint()), kMarked);
  return grid;
}

}  // namespace

Routes::Routes(const Field& field) : fine_(fineGrid(field)), box_(field.region().drivable()->box()) {
  const Point2d size = box_.max - box_.min;
  const double wanted = std::sqrt(size.x() * size.y() / kCoarseCells);
  const int ratio = std::max(1, static_cast<int>(std::lround(wanted / fine_.cell())));
  cell_ = ratio * fine_.cell();
  columns_ = fine_.columns() / ratio + 1;
  rows_ = fine_.rows() / ratio + 1;
  open_.assign(static_cast<std::size_t>(columns_ * rows_), 0);
  for (int row = 0; row < fine_.rows(); ++row) {
    for (int column = 0; column < fine_.columns(); ++column) {
      const bool open = (fine_.at(column, row) & kMarked) != 0;
      if (open) open_[static_cast<std::size_t>(row / ratio * columns_ + column / ratio)] = 1;
    }
  }
}

bool Routes::isStraightFree(const Point2d& from, const Point2d& to) const {
  const double length = (to - from).norm();
  const int steps = static_cast<int>(length / fine_.cell()) + 1;
  for (int i = 1; i < steps; ++i) {
    const Point2d at = from + (to - from) * (static_cast<double>(i) / steps);
    if (!isOpen(at)) return false;
  }
  return true;
}

int Routes::cellAt(const Point2d& point) const {
  const Point2d local = (point - box_.min) / cell_ + Point2d(fine_.cell() / cell_, fine_.cell() / cell_);
  const int column = std::clamp(static_cast<int>(local.x()), 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(local.y()), 0, rows_ - 1);
  return row * columns_ + column;
}

int Routes::nearestOpen(const Point2d& point) const {
  const int cell = cellAt(point);
  for (int ring = 0; ring < 4; ++ring) {
    for (int row = std::max(0, cell / columns_ - ring); row <= std::min(rows_ - 1, cell / columns_ + ring); ++row) {
      for (int column = std::max(0, cell % columns_ - ring); column <= std::min(columns_ - 1, cell % columns_ + ring);
           ++column) {
        if (open_[static_cast<std::size_t>(row * columns_ + column)]) return row * columns_ + column;
      }
    }
  }
  return -1;
}

/// Dijkstra on the eight neighbours.
const std::vector<float>& Routes::distancesFrom(int source) {
  const auto known = known_.find(source);
  if (known != known_.end()) return known->second;
  std::vector<float>& distances = known_[source];
  distances.assign(open_.size(), kFar);
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  distances[static_cast<std::size_t>(source)] = 0.0F;
  queue.emplace(0.0F, source);
  while (!queue.empty()) {
    const auto [distance, cell] = queue.top();
    queue.pop();
    if (distance > distances[static_cast<std::size_t>(cell)]) continue;
    for (int step = 0; step < 9; ++step) {
      const int column = cell % columns_ + step % 3 - 1, row = cell / columns_ + step / 3 - 1;
      if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
      const int next = row * columns_ + column;
      if (!open_[static_cast<std::size_t>(next)]) continue;
      const auto length = static_cast<float>(cell_ * (step % 2 == 0 ? M_SQRT2 : 1.0));
      if (distance + length >= distances[static_cast<std::size_t>(next)]) continue;
      distances[static_cast<std::size_t>(next)] = distance + length;
      queue.emplace(distance + length, next);
    }
  }
  return distances;
}

double Routes::distance(const Point2d& from, const Point2d& to) {
  const double straight = (to - from).norm();
  if (isStraightFree(from, to)) return straight;
  int begin = nearestOpen(from), end = nearestOpen(to);
  if (begin < 0 || end < 0) return kUnreachable;
  if (known_.count(end) > 0) std::swap(begin, end);  // it is as far the other way
  const double found = static_cast<double>(distancesFrom(begin)[static_cast<std::size_t>(end)]);
  return std::isfinite(found) ? std::max(straight, found) : kUnreachable;
}

}  // namespace external_command
