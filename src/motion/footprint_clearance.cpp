// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "footprint_index.h"

namespace external_command {

/// Boxes around edges that follow each other, which mostly lie side by side.
void FootprintIndex::makeBlocks() {
  for (std::size_t first = 0; first < edges_.size(); first += kBlock) {
    Point2d low(edges_[first].mx, edges_[first].my), high = low;
    for (std::size_t i = first; i < std::min(first + kBlock, edges_.size()); ++i) {
      const Point2d middle(edges_[i].mx, edges_[i].my), half(std::abs(edges_[i].hx), std::abs(edges_[i].hy));
      low = low.cwiseMin(middle - half);
      high = high.cwiseMax(middle + half);
    }
    blocks_.emplace_back(low, high);
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
  // cheap lower bound first: circle around the footprint, box around a block of edges or an edge
  const auto isFar = [&](const HalfEdge& around) {
    const double dx = std::max(std::abs(around.mx - cx) - std::abs(around.hx), 0.0);
    const double dy = std::max(std::abs(around.my - cy) - std::abs(around.hy), 0.0);
    const double reach = std::max(best.distance, best.room + margin_) + circumradius;
    return dx * dx + dy * dy > reach * reach;
  };
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    if (isFar(blocks_[block])) continue;
    const std::size_t end = std::min((block + 1) * kBlock, edges_.size());
    for (std::size_t i = block * kBlock; i < end; ++i) {
      if (isFar(edges_[i])) continue;
      const double distance = exactDistance(edges_[i], frame, cx, cy);
      best.distance = std::min(best.distance, distance);
      best.room = std::min(best.room, distance - marginTo(i));
      if (distance <= 0.0) return {0.0, -margin_};
    }
  }
  return obstacles_.filledBy(Point2d(cx, cy)) ? Clearance{0.0, -margin_} : best;
}

}  // namespace external_command
