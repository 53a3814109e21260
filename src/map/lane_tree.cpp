// SPDX-License-Identifier: Apache-2.0
#include "lane_tree.h"

#include <algorithm>

#include "external_command/core/in_parallel.h"

namespace external_command {

namespace {

constexpr std::size_t kPieceSize = 8;      // [segments]
constexpr std::size_t kLeastPart = 10000;  // of the pieces, that a thread of its own is worth

BoundingBox boxOf(const std::vector<Point2d>& points, std::size_t first, std::size_t last) {
  BoundingBox box{points[first], points[first]};
  for (std::size_t i = first + 1; i <= last; ++i) {
    box.min = box.min.cwiseMin(points[i]);
    box.max = box.max.cwiseMax(points[i]);
  }
  return box;
}

}  // namespace

LaneTree::LaneTree(const std::vector<Lane>& lanes) {
  std::size_t count = 0;
  for (const Lane& lane : lanes) count += (lane.center.points().size() + kPieceSize - 2) / kPieceSize;
  pieces_.reserve(count);
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    const std::vector<Point2d>& points = lanes[lane].center.points();
    for (std::size_t first = 0; first + 1 < points.size(); first += kPieceSize) {
      const std::size_t last = std::min(first + kPieceSize, points.size() - 1);
      pieces_.push_back({boxOf(points, first, last), static_cast<LaneIndex>(lane), static_cast<std::uint32_t>(first),
                         static_cast<std::uint32_t>(last)});
    }
  }
  if (pieces_.empty()) return;
  std::size_t first = 0;  // of the boxes of one depth
  for (std::size_t most = pieces_.size(); most > kLeafSize; most -= most / 2) first = 2 * first + 1;
  boxes_.resize(2 * first + 1);
  build({0, 0, pieces_.size()}, parallelParts(pieces_.size() / kLeastPart));
}

void LaneTree::build(const Node& node, std::size_t threads) {
  BoundingBox box = pieces_[node.begin].box;
  for (std::size_t i = node.begin + 1; i < node.end; ++i) {
    box.min = box.min.cwiseMin(pieces_[i].box.min);
    box.max = box.max.cwiseMax(pieces_[i].box.max);
  }
  boxes_[node.index] = box;
  if (node.isLeaf()) return;
  const Point2d size = box.max - box.min;
  const int axis = size.x() > size.y() ? 0 : 1;
  const auto begin = pieces_.begin();
  std::nth_element(begin + node.begin, begin + node.middle(), begin + node.end,
                   [axis](const LanePiece& a, const LanePiece& b) {
                     return a.box.min[axis] + a.box.max[axis] < b.box.min[axis] + b.box.max[axis];
                   });
  const Node children[] = {node.left(), node.right()};
  if (threads > 1) {
    inParallel(2, [&](std::size_t i) { build(children[i], i == 0 ? threads / 2 : threads - threads / 2); });
  } else {
    for (const Node& child : children) build(child, 1);
  }
}

}  // namespace external_command
