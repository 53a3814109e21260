// SPDX-License-Identifier: Apache-2.0
#include "contraction_hierarchy.h"

#include <algorithm>

#include "elimination_order.h"

namespace external_command {

namespace {

constexpr std::int32_t kUnreachable = RelaxedGraph::kUnreachable;

void lower(std::int32_t value, std::int32_t* weight) { *weight = std::min(*weight, value); }

}  // namespace

/// Arcs are kept as pairs, one each way, between a node and one above it, by the lower node and then by the upper.
class ContractionHierarchy::Builder {
 public:
  Builder(const RelaxedGraph& graph, ContractionHierarchy* result) : graph_(graph), result_(*result) {}

  void build() {
    setRanks();
    linkUppers();
    listLowers();
    setWeights();
    lowerByTrianglesBelow();
    detourByTrianglesAbove();
    keepNeeded(up_, up_detour_, &result_.first_up_, &result_.up_);
    keepNeeded(down_, down_detour_, &result_.first_down_, &result_.down_);
  }

 private:
  void setRanks() {
    const std::vector<LaneIndex> order = eliminationOrder(graph_);
    result_.rank_.resize(graph_.size());
    for (std::uint32_t rank = 0; rank < order.size(); ++rank) result_.rank_[order[rank]] = rank;
  }

  /// Where a node is taken out, all nodes above it that it links become linked to each other.
  void linkUppers() {
    std::vector<std::vector<std::uint32_t>> uppers(graph_.size());
    for (const RelaxedGraph::Arc& arc : graph_.arcs) {
      const auto [low, high] = std::minmax(result_.rank_[arc.tail], result_.rank_[arc.head]);
      if (low != high) uppers[low].push_back(high);
    }
    result_.parent_.assign(graph_.size(), kNoParent);
    first_.push_back(0);
    for (std::vector<std::uint32_t>& own : uppers) {
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      if (!own.empty()) {
        result_.parent_[first_.size() - 1] = own.front();
        std::vector<std::uint32_t>& parents = uppers[own.front()];
        parents.insert(parents.end(), own.begin() + 1, own.end());
      }
      upper_.insert(upper_.end(), own.begin(), own.end());
      first_.push_back(static_cast<std::uint32_t>(upper_.size()));
      own = {};
    }
  }

  /// For each node the pairs that lead to it from below.
  void listLowers() {
    first_lower_.assign(graph_.size() + 1, 0);
    for (const std::uint32_t upper : upper_) ++first_lower_[upper + 1];
    for (std::size_t i = 1; i < first_lower_.size(); ++i) first_lower_[i] += first_lower_[i - 1];
    std::vector<std::uint32_t> next(first_lower_.begin(), first_lower_.end() - 1);
    lower_.resize(upper_.size());
    for (std::uint32_t low = 0; low < graph_.size(); ++low) {
      for (std::uint32_t pair = first_[low]; pair < first_[low + 1]; ++pair) {
        lower_[next[upper_[pair]]++] = {pair, first_[low + 1]};
      }
    }
  }

  void setWeights() {
    up_.assign(upper_.size(), kUnreachable);
    down_ = up_;
    for (const RelaxedGraph::Arc& arc : graph_.arcs) {
      const std::uint32_t tail = result_.rank_[arc.tail], head = result_.rank_[arc.head];
      if (tail == head) continue;
      const std::uint32_t low = std::min(tail, head);
      const auto begin = upper_.begin() + first_[low], end = upper_.begin() + first_[low + 1];
      const auto pair = static_cast<std::size_t>(std::lower_bound(begin, end, std::max(tail, head)) - upper_.begin());
      lower(arc.weight, tail < head ? &up_[pair] : &down_[pair]);
    }
  }

  /// Calls `visit(to_middle, to_top, middle_to_top)` with the pairs of each triangle whose middle node is `middle`.
  template <class Visit>
  void visitTriangles(std::uint32_t middle, const Visit& visit) {
    for (std::uint32_t pair = first_[middle]; pair < first_[middle + 1]; ++pair) pair_to_[upper_[pair]] = pair;
    for (std::uint32_t i = first_lower_[middle]; i < first_lower_[middle + 1]; ++i) {
      for (std::uint32_t to_top = lower_[i].pair + 1; to_top < lower_[i].end; ++to_top) {
        visit(lower_[i].pair, to_top, pair_to_[upper_[to_top]]);
      }
    }
  }

  void lowerByTrianglesBelow() {
    pair_to_.resize(graph_.size());
    for (std::uint32_t middle = 0; middle < graph_.size(); ++middle) {
      visitTriangles(middle, [this](std::uint32_t to_middle, std::uint32_t to_top, std::uint32_t onward) {
        lower(down_[to_middle] + up_[to_top], &up_[onward]);
        lower(down_[to_top] + up_[to_middle], &down_[onward]);
      });
    }
  }

  /// The shortest way other than the arc itself, over nodes above its lower end.
  void detourByTrianglesAbove() {
    up_detour_.assign(upper_.size(), kUnreachable);
    down_detour_ = up_detour_;
    for (auto middle = static_cast<std::uint32_t>(graph_.size()); middle-- > 0;) {
      visitTriangles(middle, [this](std::uint32_t to_middle, std::uint32_t to_top, std::uint32_t onward) {
        const std::int32_t up = std::min(up_[onward], up_detour_[onward]);
        const std::int32_t down = std::min(down_[onward], down_detour_[onward]);
        // Of two arcs between whose ends nothing is to be driven one has to stay.
        if (up > 0) lower(up_[to_middle] + up, &up_detour_[to_top]);
        if (down > 0) lower(up_[to_top] + down, &up_detour_[to_middle]);
        if (down > 0) lower(down_[to_middle] + down, &down_detour_[to_top]);
        if (up > 0) lower(down_[to_top] + up, &down_detour_[to_middle]);
      });
    }
  }

  void keepNeeded(const std::vector<std::int32_t>& weights, const std::vector<std::int32_t>& detours,
                  std::vector<std::uint32_t>* first, std::vector<Arc>* arcs) const {
    first->push_back(0);
    for (std::uint32_t low = 0; low < graph_.size(); ++low) {
      for (std::uint32_t pair = first_[low]; pair < first_[low + 1]; ++pair) {
        if (weights[pair] < detours[pair]) arcs->push_back({upper_[pair], weights[pair]});
      }
      first->push_back(static_cast<std::uint32_t>(arcs->size()));
    }
    arcs->shrink_to_fit();
  }

  /// A pair that leads up from some node, and the end of all that do.
  struct LowerPair {
    std::uint32_t pair, end;
  };

  const RelaxedGraph& graph_;
  ContractionHierarchy& result_;
  std::vector<std::uint32_t> first_, upper_;
  std::vector<std::int32_t> up_, down_, up_detour_, down_detour_;
  std::vector<std::uint32_t> first_lower_;
  std::vector<LowerPair> lower_;
  std::vector<std::uint32_t> pair_to_;
};

ContractionHierarchy::ContractionHierarchy(const RelaxedGraph& graph) { Builder(graph, this).build(); }

}  // namespace external_command
