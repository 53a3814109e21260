// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "relaxed_graph.h"

namespace external_command {

/// A contraction hierarchy over the relaxed graph, made as a customizable one is (Dibbelt, Strasser, Wagner,
/// "Customizable contraction hierarchies", 2016): the order comes from the shape of the graph alone; then all triangles
/// below each arc give it its weight, and those above tell which arcs no shortest way needs. Nodes are ranks, the one
/// taken out first is 0. Arcs lead up, and all nodes above one that they reach lie on the way from it to the root of
/// the elimination tree. Immutable.
class ContractionHierarchy {
 public:
  static constexpr std::uint32_t kNoParent = 0xffffffffU;

  struct Arc {
    std::uint32_t upper;
    std::int32_t weight;  ///< [1 / RelaxedGraph::kUnitsPerMetre m]
  };

  explicit ContractionHierarchy(const RelaxedGraph& graph);

  /// Empty, for what was kept.
  ContractionHierarchy() = default;

  /// Calls `visit(array)` for each array of which the hierarchy consists, by which it can be kept.
  template <class Visit>
  void forEachArray(const Visit& visit) const {
    for (const auto* array : {&rank_, &parent_, &first_up_, &first_down_}) visit(*array);
    for (const auto* array : {&up_, &down_}) visit(*array);
  }
  template <class Visit>
  void forEachArray(const Visit& visit) {
    for (auto* array : {&rank_, &parent_, &first_up_, &first_down_}) visit(*array);
    for (auto* array : {&up_, &down_}) visit(*array);
  }

  std::size_t size() const { return rank_.size(); }
  std::uint32_t rank(LaneIndex lane) const { return rank_[lane]; }
  std::uint32_t parent(std::uint32_t rank) const { return parent_[rank]; }

  /// From this node up to others.
  Span<Arc> arcsUp(std::uint32_t rank) const { return spanOf(up_, first_up_, rank); }
  /// From others down to this node.
  Span<Arc> arcsDown(std::uint32_t rank) const { return spanOf(down_, first_down_, rank); }

  std::size_t arcs() const { return up_.size() + down_.size(); }

 private:
  class Builder;

  static Span<Arc> spanOf(const std::vector<Arc>& arcs, const std::vector<std::uint32_t>& first, std::uint32_t rank) {
    return {arcs.data() + first[rank], arcs.data() + first[rank + 1]};
  }

  std::vector<std::uint32_t> rank_, parent_, first_up_, first_down_;
  std::vector<Arc> up_, down_;
};

}  // namespace external_command
