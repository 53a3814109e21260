// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "footprint_index.h"

namespace external_command {

namespace {

constexpr std::uint32_t kGroupsAtOnce = 4;     ///< between two checkpoints: a group may lie in all cells
constexpr std::size_t kPairsAtOnce = 1 << 18;  ///< between two checkpoints

}  // namespace

/// Lists the edges in the cells from which the footprint reaches them, in groups. Where even so they would take too
/// much memory the groups are larger, and what is near takes longer to test.
void FootprintIndex::spreadEdges(const Checkpoint& checkpoint) {
  constexpr std::array<GroupSize, 2> kSizes{{{0.5, 16}, {2.0, 256}}};
  near_.assign(states_.size(), static_cast<float>(listReach()));
  const std::size_t most = obstacles_.region().limits().max_near_edges;
  for (const GroupSize& size : kSizes) {
    makeGroups(size);
    std::vector<CellGroup> pairs;
    if (spreadGroups(most, &pairs, checkpoint)) return list(pairs, checkpoint);
  }
  throw InvalidRequest(text("the region's obstacles have ", edges_.size(), " edges, too many in one place: more ",
                            "than ", most, " in sum over the cells near them (~free_space/max_near_edges), short ones ",
                            "side by side counted as one; give a smaller region or a coarser grid"));
}

void FootprintIndex::makeGroups(const GroupSize& most) {
  groups_.clear();
  const std::vector<ObstacleEdge>& edges = obstacles_.edges();
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    Point2d low = edges[first].begin, high = low;
    for (; last < edges.size() && last - first < most.edges && edges[last].source == edges[first].source; ++last) {
      low = low.cwiseMin(edges[last].begin).cwiseMin(edges[last].end);
      high = high.cwiseMax(edges[last].begin).cwiseMax(edges[last].end);
      if (last > first && (high - low).norm() > most.extent) break;
    }
    addGroup(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
  }
}

/// The core leads from the first corner to the one farthest from it.
void FootprintIndex::addGroup(std::uint32_t first, std::uint32_t last) {
  const std::vector<ObstacleEdge>& edges = obstacles_.edges();
  if (last - first == 1) return groups_.push_back({edges_[first], 0.0, first, last});
  const Point2d begin = edges[first].begin;
  const auto forEachCorner = [&](const auto& visit) {
    for (std::uint32_t i = first; i < last; ++i) visit(edges[i].begin), visit(edges[i].end);
  };
  Point2d end = begin;
  forEachCorner([&](const Point2d& corner) {
    if ((corner - begin).squaredNorm() > (end - begin).squaredNorm()) end = corner;
  });
  EdgeGroup group{HalfEdge(begin, end), 0.0, first, last};
  forEachCorner([&](const Point2d& corner) { group.radius = std::max(group.radius, group.core.distanceFrom(corner)); });
  group.radius += 1e-9;  // for rounding
  groups_.push_back(group);
}

/// @return false where there are more than `most` pairs.
bool FootprintIndex::spreadGroups(std::size_t most, std::vector<CellGroup>* pairs, const Checkpoint& checkpoint) {
  for (std::uint32_t group = 0; group < groups_.size(); ++group) {
    if (group % kGroupsAtOnce == 0) checkpoint();
    spread(group, pairs);
    if (pairs->size() > most) return false;
  }
  return true;
}

/// Lists the group in its cells, and lowers their `near_` to the distance from its nearest edge.
void FootprintIndex::spread(std::uint32_t number, std::vector<CellGroup>* pairs) {
  const EdgeGroup& group = groups_[number];
  const HalfEdge& core = group.core;
  const double reach = listReach() + group.radius;
  const Point2d centre = cellCentre(0, 0);
  const auto firstFrom = [&](double value, double corner) {
    return std::max(0L, static_cast<long>(std::ceil((value - corner) / cell_size_)));
  };
  const auto lastTo = [&](double value, double corner, long count) {
    return std::min(count - 1, static_cast<long>(std::floor((value - corner) / cell_size_)));
  };
  const double wide = std::abs(core.hx) + reach, high = std::abs(core.hy) + reach;
  const long last_row = lastTo(core.my + high, centre.y(), rows_);
  const long first_column = firstFrom(core.mx - wide, centre.x());
  const long last_column = lastTo(core.mx + wide, centre.x(), columns_);
  for (long row = firstFrom(core.my - high, centre.y()); row <= last_row; ++row) {
    for (long column = first_column; column <= last_column; ++column) {
      const Point2d point = cellCentre(column, row);
      const double distance = core.distanceFrom(point);
      if (distance > reach) continue;
      const auto cell = static_cast<std::uint32_t>(row * columns_ + column);
      pairs->push_back({cell, number});
      if (distance - group.radius >= static_cast<double>(near_[cell])) continue;
      for (std::uint32_t i = group.first; i < group.last; ++i) {
        near_[cell] = std::min(near_[cell], static_cast<float>(edges_[i].distanceFrom(point)));
      }
    }
  }
}

/// The pairs by cell (counting sort).
void FootprintIndex::list(const std::vector<CellGroup>& pairs, const Checkpoint& checkpoint) {
  starts_.assign(states_.size() + 1, 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i % kPairsAtOnce == 0) checkpoint();
    ++starts_[pairs[i].cell + 1];
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  listed_.resize(pairs.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i % kPairsAtOnce == 0) checkpoint();
    listed_[next[pairs[i].cell]++] = pairs[i].group;
  }
}

/// Beyond the reach of the lists, bounds `near_` from below by a chamfer distance transform from the cells that hold an
/// edge: steps of 1 and sqrt(2) overestimate the straight distance by at most 1 / kChamfer.
void FootprintIndex::extendNear() {
  constexpr double kChamfer = 0.92;
  std::vector<float> steps(near_.size());
  for (std::size_t i = 0; i < near_.size(); ++i) steps[i] = near_[i] <= cell_reach_ ? 0.0F : 1e6F;
  const auto lower = [&](long column, long row, long dc, long dr) {
    const long c = column + dc, r = row + dr;
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return;
    float& here = steps[static_cast<std::size_t>(row * columns_ + column)];
    const float cost = dc != 0 && dr != 0 ? 1.41421356F : 1.0F;
    here = std::min(here, steps[static_cast<std::size_t>(r * columns_ + c)] + cost);
  };
  for (long row = 0; row < rows_; ++row) {
    for (long column = 0; column < columns_; ++column) {
      for (const long dc : {-1L, 0L, 1L}) lower(column, row, dc, -1);
      lower(column, row, -1, 0);
    }
  }
  for (long row = rows_ - 1; row >= 0; --row) {
    for (long column = columns_ - 1; column >= 0; --column) {
      for (const long dc : {-1L, 0L, 1L}) lower(column, row, dc, 1);
      lower(column, row, 1, 0);
    }
  }
  for (long row = 0; row < rows_; ++row) {
    for (long column = 0; column < columns_; ++column) {
      const auto i = static_cast<std::size_t>(row * columns_ + column);
      // Edges beyond the cells, left out because of the axle bounds, are not among the seeds.
      const long to_border = std::min({row, rows_ - 1 - row, column, columns_ - 1 - column});
      const double known = std::min(static_cast<double>(steps[i]) * kChamfer, static_cast<double>(to_border));
      near_[i] = std::max(near_[i], static_cast<float>(known * cell_size_ - cell_reach_));
    }
  }
}

}  // namespace external_command
