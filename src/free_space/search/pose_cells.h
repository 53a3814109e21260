// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

/// Number of the cell of position and heading that holds a pose. Its lowest bit is 0, for a caller with two kinds of
/// nodes. Positions within 100,000 cells of the origin have numbers of their own.
/// @param cell          its side [m]
/// @param heading_cell  a whole part of a turn [rad]
/// @param shift         of the cells' borders, part of a cell
inline std::uint64_t cellOf(const Pose2d& pose, double cell, double heading_cell, double shift = 0.0) {
  const auto number = [&](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / cell + shift)) + (1 << 20)) &
           0x1FFFFF;
  };
  const double turns = 2.0 * M_PI / heading_cell;
  const auto heading = static_cast<std::uint64_t>(std::llround((pose.heading / (2.0 * M_PI) + 1.0) * turns + shift) %
                                                  std::llround(turns));
  return number(pose.x) << 40 | number(pose.y) << 19 | heading << 1;
}

/// The node of each cell: a hash table with open addressing.
class CellNodes {
 public:
  static constexpr int kNone = -1;

  CellNodes() { clear(); }

  void clear() {
    cells_.assign(kFirstSize, kNoCell);
    nodes_.assign(kFirstSize, kNone);
    used_ = 0;
  }

  /// The cell's node; kNone where there is none.
  int at(std::uint64_t cell) const { return nodes_[slotOf(cell)]; }

  void set(std::uint64_t cell, int node) {
    if (used_ * 2 >= cells_.size()) grow();
    const std::size_t slot = slotOf(cell);
    if (cells_[slot] == kNoCell) ++used_;
    cells_[slot] = cell;
    nodes_[slot] = node;
  }

 private:
  static constexpr std::uint64_t kNoCell = ~0ULL;
  static constexpr std::size_t kFirstSize = 4096;  ///< a power of two, like all sizes

  std::size_t slotOf(std::uint64_t cell) const {
    const std::size_t mask = cells_.size() - 1;
    std::size_t slot = (cell * 0x9E3779B97F4A7C15ULL >> 32) & mask;
    while (cells_[slot] != kNoCell && cells_[slot] != cell) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    const std::vector<std::uint64_t> cells = std::move(cells_);
    const std::vector<int> nodes = std::move(nodes_);
    cells_.assign(cells.size() * 2, kNoCell);
    nodes_.assign(cells.size() * 2, kNone);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == kNoCell) continue;
      const std::size_t slot = slotOf(cells[i]);
      cells_[slot] = cells[i];
      nodes_[slot] = nodes[i];
    }
  }

  std::vector<std::uint64_t> cells_;
  std::vector<int> nodes_;
  std::size_t used_ = 0;
};

}  // namespace external_command
