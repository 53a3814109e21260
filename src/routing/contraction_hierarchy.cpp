// SPDX-License-Identifier: Apache-2.0
#include "contraction_hierarchy.h"

#include <algorithm>
#include <memory>

#include "elimination_order.h"
#include "external_command/core/in_parallel.h"
#include "supernodes.h"
#include "tree_walk.h"
#include "wide.h"

namespace external_command {

namespace {

using Weight = std::int32_t;
using Weights = std::vector<Weight>;

constexpr Weight kUnreachable = RelaxedGraph::kUnreachable;
constexpr std::size_t kNodesPerThread = 20000;  // with fewer a thread is not worth its making

void lower(Weight value, Weight* weight) { *weight = std::min(*weight, value); }

/// Lowers each of `targets` to `start` and what leads on from there.
inline void lowerAll(Weight start, const Weight* onward, std::size_t count, Weight* targets) {
  for (std::size_t i = 0; i < count; ++i) targets[i] = std::min(targets[i], start + onward[i]);
}

/// The least sum of two that belong together.
inline Weight leastSum(const Weight* a, const Weight* b, std::size_t count) {
  Weight least = kUnreachable;
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, a[i] + b[i]);
  return least;
}

/// Part of a row of arcs up, and of the same row of arcs down.
struct RowPart {
  RowPart from(std::size_t column) const { return {up + column, down + column}; }

  Weight *up, *down;
};

/// The ways between one node and others over a node below: `up` and `down` lead from and to that one.
EXTERNAL_COMMAND_WIDE void lowerOver(Weight up, Weight down, RowPart onward, std::size_t count, RowPart targets) {
  lowerAll(down, onward.up, count, targets.up);
  lowerAll(up, onward.down, count, targets.down);
}

/// The ways between a node and others above it, over the first of these: `own` are the node's arcs from that first one
/// on, `onward` that one's to the rest.
EXTERNAL_COMMAND_WIDE void lowerDetours(RowPart own, RowPart onward, std::size_t count, RowPart detours) {
  lowerAll(*own.up, onward.up, count, detours.up + 1);
  lowerAll(*own.down, onward.down, count, detours.down + 1);
  lower(leastSum(own.up + 1, onward.down, count), detours.up);
  lower(leastSum(own.down + 1, onward.up, count), detours.down);
}

/// Of some supernodes above another: which columns its nodes above have there.
class ColumnsAbove {
 public:
  /// Calls `visit(node, upper, i, columns)` for each node above `low`: it is the `i`th, of supernode `upper`, and
  /// `columns[k]` is where the `k`th is in its rows, from i + 1 on.
  template <class Visit>
  void visit(const Supernodes& supernodes, const Supernode& low, const Visit& visit) {
    columns_.resize(low.above.size());
    const Supernode* upper = nullptr;
    for (std::size_t i = 0; i < low.above.size(); ++i) {
      const std::uint32_t node = low.above[i];
      if (upper == nullptr || node >= upper->first + upper->count) {
        upper = &supernodes.of(node);
        for (std::size_t k = i; k < columns_.size(); ++k) columns_[k] = upper->columnOf(low.above[k]);
      }
      visit(node, *upper, i, columns_);
    }
  }

 private:
  std::vector<std::size_t> columns_;
};

std::vector<std::vector<std::uint32_t>> uppersOf(const RelaxedGraph& graph, const std::vector<std::uint32_t>& rank) {
  std::vector<std::vector<std::uint32_t>> uppers(graph.size());
  for (const RelaxedGraph::Arc& arc : graph.arcs) {
    const auto [low, high] = std::minmax(rank[arc.tail], rank[arc.head]);
    if (low != high) uppers[low].push_back(high);
  }
  return uppers;
}

}  // namespace

/// A node's row holds the weights of its arcs up to the columns' nodes, and in a second array those of the arcs down
/// from there; what lies below the node in a supernode is not used.
class ContractionHierarchy::Builder {
 public:
  Builder(const RelaxedGraph& graph, ContractionHierarchy* result)
      : graph_(graph),
        result_(*result),
        supernodes_(uppersOf(graph, result->rank_)),
        up_(supernodes_.cells(), kUnreachable),
        down_(supernodes_.cells(), kUnreachable),
        kept_up_(supernodes_.size()),
        kept_down_(supernodes_.size()) {}

  void build() {
    setWeights();
    for (const Supernode& own : supernodes_.all()) {
      lowerInside(own);
      lowerAbove(own);
    }
    dropDetours();
    store();
  }

 private:
  class DetourFilter;

  void setWeights() {
    for (const RelaxedGraph::Arc& arc : graph_.arcs) {
      const std::uint32_t tail = result_.rank_[arc.tail], head = result_.rank_[arc.head];
      if (tail == head) continue;
      const Supernode& own = supernodes_.of(std::min(tail, head));
      const std::size_t cell = own.row(std::min(tail, head)) + own.columnOf(std::max(tail, head));
      lower(arc.weight, tail < head ? &up_[cell] : &down_[cell]);
    }
  }

  /// Ways over a node below, between nodes of one supernode and from there up.
  void lowerInside(const Supernode& own) {
    const std::size_t width = own.width();
    for (std::size_t below = 0; below < own.count; ++below) {
      const RowPart low = part(own.rows + below * width);
      for (std::size_t i = below + 1; i < own.count; ++i) {
        lowerOver(low.up[i], low.down[i], low.from(i + 1), width - i - 1, part(own.rows + i * width + i + 1));
      }
    }
  }

  /// Ways over the nodes of a supernode, between nodes above it.
  void lowerAbove(const Supernode& own) {
    const std::size_t width = own.width();
    columns_.visit(supernodes_, own,
                   [&](std::uint32_t node, const Supernode& upper, std::size_t i, const auto& columns) {
                     const std::size_t rest = own.above.size() - i - 1, column = own.count + i;
                     way_up_.assign(rest, kUnreachable);
                     way_down_.assign(rest, kUnreachable);
                     for (std::size_t row = own.rows; row < own.rows + own.count * width; row += width) {
                       const RowPart low = part(row + column);
                       lowerOver(*low.up, *low.down, low.from(1), rest, {way_up_.data(), way_down_.data()});
                     }
                     const std::size_t row = upper.row(node);
                     for (std::size_t k = 0; k < rest; ++k) {
                       lower(way_up_[k], &up_[row + columns[i + 1 + k]]);
                       lower(way_down_[k], &down_[row + columns[i + 1 + k]]);
                     }
                   });
  }

  void dropDetours();

  RowPart part(std::size_t cell) { return {up_.data() + cell, down_.data() + cell}; }

  /// From the lowest node up.
  void store() {
    for (std::uint32_t node = 0; node < supernodes_.size(); ++node) {
      result_.parent_.push_back(supernodes_.parent(node, kNoParent));
    }
    storeArcs(kept_up_, &result_.first_up_, &result_.up_);
    storeArcs(kept_down_, &result_.first_down_, &result_.down_);
  }

  static void storeArcs(const std::vector<std::vector<Arc>>& kept, std::vector<std::uint32_t>* first,
                        std::vector<Arc>* arcs) {
    std::size_t count = 0;
    for (const std::vector<Arc>& own : kept) count += own.size();
    arcs->reserve(count);
    first->push_back(0);
    for (const std::vector<Arc>& own : kept) {
      arcs->insert(arcs->end(), own.begin(), own.end());
      first->push_back(static_cast<std::uint32_t>(arcs->size()));
    }
  }

  const RelaxedGraph& graph_;
  ContractionHierarchy& result_;
  const Supernodes supernodes_;
  Weights up_, down_;
  std::vector<std::vector<Arc>> kept_up_, kept_down_;  // by lower node
  ColumnsAbove columns_;
  Weights way_up_, way_down_;
};

/// Keeps the arcs of a supernode that are shorter than any way over a node above their lower end; then their weights
/// become those of the shortest ways. For one thread.
class ContractionHierarchy::Builder::DetourFilter {
 public:
  explicit DetourFilter(Builder* all) : all_(*all) {}

  void run(const Supernode& own) {
    const std::size_t width = own.width();
    detour_up_.assign(own.count * width, kUnreachable);
    detour_down_.assign(own.count * width, kUnreachable);
    columns_.visit(all_.supernodes_, own,
                   [&](std::uint32_t node, const Supernode& upper, std::size_t i, const auto& columns) {
                     const RowPart row = all_.part(upper.row(node));
                     way_up_.clear();
                     way_down_.clear();
                     for (auto column = columns.begin() + i + 1; column != columns.end(); ++column) {
                       way_up_.push_back(row.up[*column]);
                       way_down_.push_back(row.down[*column]);
                     }
                     lookForDetours(own, own.count, own.count + i);
                   });
    for (std::size_t k = own.count; k-- > 0;) {
      keepNeeded(own, k, detour_up_, &all_.up_, &all_.kept_up_);
      keepNeeded(own, k, detour_down_, &all_.down_, &all_.kept_down_);
      const RowPart row = all_.part(own.rows + k * width + k + 1);
      way_up_.assign(row.up, row.up + (width - k - 1));
      way_down_.assign(row.down, row.down + (width - k - 1));
      lookForDetours(own, k, k);
    }
  }

 private:
  /// For the arcs of the first `count` nodes of `own`, over the node of column `over`, from which `way_up_` and
  /// `way_down_` lead to and from those of the columns after it. Of two arcs between whose ends nothing is to be driven
  /// one has to stay: neither is a detour of the other.
  void lookForDetours(const Supernode& own, std::size_t count, std::size_t over) {
    for (Weights* weights : {&way_up_, &way_down_}) {
      for (Weight& weight : *weights) weight = weight > 0 ? weight : kUnreachable;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t begin = k * own.width() + over;
      lowerDetours(all_.part(own.rows + begin), {way_up_.data(), way_down_.data()}, way_up_.size(),
                   {&detour_up_[begin], &detour_down_[begin]});
    }
  }

  static void keepNeeded(const Supernode& own, std::size_t k, const Weights& detours, Weights* weights,
                         std::vector<std::vector<Arc>>* kept) {
    std::vector<Arc>& arcs = (*kept)[own.first + k];
    for (std::size_t column = k + 1; column < own.width(); ++column) {
      Weight& weight = (*weights)[own.rows + k * own.width() + column];
      const Weight detour = detours[k * own.width() + column];
      if (weight < detour) arcs.push_back({own.nodeAt(column), weight});
      lower(detour, &weight);
    }
  }

  Builder& all_;
  ColumnsAbove columns_;
  Weights way_up_, way_down_, detour_up_, detour_down_;
};

/// Each supernode needs those above it only.
void ContractionHierarchy::Builder::dropDetours() {
  std::vector<std::size_t> parents;
  for (const Supernode& own : supernodes_.all()) {
    parents.push_back(own.above.empty() ? TreeWalk::kNoParent : supernodes_.indexOf(own.above.front()));
  }
  TreeWalk(parents).run(parallelParts(supernodes_.size() / kNodesPerThread), [this] {
    return [this, filter = std::make_shared<DetourFilter>(this)](std::size_t i) { filter->run(supernodes_.all()[i]); };
  });
}

ContractionHierarchy::ContractionHierarchy(const RelaxedGraph& graph) : rank_(graph.size()) {
  const std::vector<LaneIndex> order = eliminationOrder(graph);
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) rank_[order[rank]] = rank;
  Builder(graph, this).build();
}

}  // namespace external_command
