// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "external_command/map/hd_map.h"

namespace external_command {

/// A few consecutive segments of a lane's centre line: those between the points `first` and `last`.
struct LanePiece {
  BoundingBox box;
  LaneIndex lane;
  std::uint32_t first;
  std::uint32_t last;
};

/// A balanced tree of bounding boxes over the centre lines of all lanes (a bounding volume hierarchy, split at the
/// median of the longer side). Built in O(n log n); a nearest query visits O(log n) boxes. Const and thread-safe.
class LaneTree {
 public:
  LaneTree() = default;
  explicit LaneTree(const std::vector<Lane>& lanes);

  /// Calls `visit(array)` for each array of which the tree consists, by which it can be kept.
  template <class Visit>
  void forEachArray(const Visit& visit) const {
    visit(pieces_);
    visit(boxes_);
  }
  template <class Visit>
  void forEachArray(const Visit& visit) {
    visit(pieces_);
    visit(boxes_);
  }

  /// Calls `visit(piece, bound)` for every piece whose box is not farther from `point` than `bound` [m^2, squared
  /// distance], the nearer halves of the tree first. `visit` returns the bound to go on with.
  template <class Visit>
  void visitNear(const Point2d& point, double bound, Visit&& visit) const {
    if (!pieces_.empty()) visitNode({0, 0, pieces_.size()}, point, visit, &bound);
  }

 private:
  static constexpr std::size_t kLeafSize = 4;  // [pieces]

  /// The node at `index` of the implicit tree holds the pieces [begin, end); its children share them half and half.
  struct Node {
    std::size_t index, begin, end;

    bool isLeaf() const { return end - begin <= kLeafSize; }
    std::size_t middle() const { return begin + (end - begin) / 2; }
    Node left() const { return {2 * index + 1, begin, middle()}; }
    Node right() const { return {2 * index + 2, middle(), end}; }
  };

  void build(const Node& node, std::size_t threads);

  static double squaredDistance(const BoundingBox& box, const Point2d& point) {
    return (box.min - point).cwiseMax(point - box.max).cwiseMax(0.0).squaredNorm();
  }

  template <class Visit>
  void visitNode(const Node& node, const Point2d& point, Visit&& visit, double* bound) const {
    if (node.isLeaf()) {
      for (std::size_t i = node.begin; i < node.end; ++i) {
        if (squaredDistance(pieces_[i].box, point) <= *bound) *bound = visit(pieces_[i], *bound);
      }
      return;
    }
    Node near = node.left(), far = node.right();
    double near_distance = squaredDistance(boxes_[near.index], point);
    double far_distance = squaredDistance(boxes_[far.index], point);
    if (far_distance < near_distance) {
      std::swap(near, far);
      std::swap(near_distance, far_distance);
    }
    if (near_distance <= *bound) visitNode(near, point, visit, bound);
    if (far_distance <= *bound) visitNode(far, point, visit, bound);
  }

  std::vector<LanePiece> pieces_;
  std::vector<BoundingBox> boxes_;  // by index of the node
};

}  // namespace external_command
