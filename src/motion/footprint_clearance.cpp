// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "footprint_index.h"

namespace external_command {

namespace {

constexpr double kRounding = 1e-6;  ///< of what is between map and local frame [m]

}  // namespace

/// Of each obstacle, edges that follow each other mostly lie side by side.
void FootprintIndex::makeBlocks() {
  const std::vector<ObstacleEdge>& edges = obstacles_.edges();
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    Point2d low = edges[first].begin, high = low;
    for (; last < edges.size() && last - first < kBlock && edges[last].source == edges[first].source; ++last) {
      low = low.cwiseMin(edges[last].begin).cwiseMin(edges[last].end);
      high = high.cwiseMax(edges[last].begin).cwiseMax(edges[last].end);
    }
    blocks_.push_back({HalfEdge(low, high), static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)});
  }
  if (!blocks_.empty()) addBlockNode(0, static_cast<std::uint32_t>(blocks_.size()));
}

void FootprintIndex::addBlockNode(std::uint32_t first, std::uint32_t last) {
  const auto begin = blocks_.begin() + first, end = blocks_.begin() + last;
  Point2d low(begin->box.mx, begin->box.my), high = low;
  for (auto block = begin; block != end; ++block) {
    const Point2d middle(block->box.mx, block->box.my), half(block->box.hx, block->box.hy);
    low = low.cwiseMin(middle - half);
    high = high.cwiseMax(middle + half);
  }
  const std::size_t node = block_nodes_.size();
  block_nodes_.push_back({HalfEdge(low, high), first, last, 0});
  if (last - first == 1) return;
  const std::uint32_t middle = first + (last - first) / 2;
  const bool is_wide = high.x() - low.x() > high.y() - low.y();
  std::nth_element(begin, blocks_.begin() + middle, end, [is_wide](const Block& a, const Block& b) {
    return is_wide ? a.box.mx < b.box.mx : a.box.my < b.box.my;
  });
  addBlockNode(first, middle);
  block_nodes_[node].second_half = static_cast<std::uint32_t>(block_nodes_.size());
  addBlockNode(middle, last);
}

/// Visits the blocks whose box, and every box around it, is near. What is near may shrink meanwhile.
template <class IsNear, class Visit>
void FootprintIndex::forEachBlock(const IsNear& is_near, const Visit& visit) const {
  if (block_nodes_.empty()) return;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t number = open.back();
    const BlockNode& node = block_nodes_[number];
    open.pop_back();
    if (!is_near(node.box)) continue;
    if (node.last - node.first == 1) {
      visit(blocks_[node.first]);
    } else {
      open.push_back(node.second_half);
      open.push_back(number + 1);
    }
  }
}

double FootprintIndex::distanceTo(const ObstacleEdge& edge, const Frame& frame) const {
  return exactDistance({edge.begin, edge.end}, frame, frame.x + box_.centre * frame.cos,
                       frame.y + box_.centre * frame.sin);
}

FootprintIndex::Clearance FootprintIndex::clearance(const Frame& frame, double limit) const {
  const double cx = frame.x + box_.centre * frame.cos, cy = frame.y + box_.centre * frame.sin;
  const double circumradius = box_.circumradius();
  Clearance best{limit, limit};
  // cheap lower bound first: circle around the footprint, box around edges
  const auto isNear = [&](const HalfEdge& around) {
    const double dx = std::max(std::abs(around.mx - cx) - std::abs(around.hx), 0.0);
    const double dy = std::max(std::abs(around.my - cy) - std::abs(around.hy), 0.0);
    const double reach = std::max(best.distance, best.room + margin_) + circumradius;
    return dx * dx + dy * dy <= reach * reach;
  };
  forEachBlock(isNear, [&](const Block& block) {
    for (std::uint32_t i = block.first; i < block.last; ++i) {
      if (!isNear(edges_[i])) continue;
      const double distance = exactDistance(edges_[i], frame, cx, cy);
      best.distance = std::min(best.distance, distance);
      best.room = std::min(best.room, distance - marginTo(i));
    }
  });
  return best.distance <= 0.0 || isFilled(Point2d(cx, cy)) ? Clearance{0.0, -margin_} : best;
}

/// Of a polygon that fills the point, an edge is at the point's height and to the right of it.
bool FootprintIndex::isFilled(const Point2d& point) const {
  const Region& region = obstacles_.region();
  if (region.drivable() && obstacles_.isFilledBy(kDrivableSource, point)) return true;
  if (region.grid() && obstacles_.isFilledBy(kGridSource, point)) return true;
  bool is_filled = false;
  int asked = kDrivableSource;
  const auto mayBeRight = [&](const HalfEdge& box) {
    return !is_filled && std::abs(point.y() - box.my) <= std::abs(box.hy) + kRounding &&
           box.mx + std::abs(box.hx) >= point.x() - kRounding;
  };
  forEachBlock(mayBeRight, [&](const Block& block) {
    const int source = obstacles_.edges()[block.first].source;
    if (source < 0 || source == asked) return;
    asked = source;
    is_filled = obstacles_.isFilledBy(source, point);
  });
  return is_filled;
}

}  // namespace external_command
