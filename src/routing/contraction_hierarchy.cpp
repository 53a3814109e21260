// SPDX-License-Identifier: Apache-2.0
#include "contraction_hierarchy.h"

#include <algorithm>
#include <tuple>

#include "elimination_order.h"
#include "supernodes.h"

namespace external_command {

namespace {

using Weight = std::int32_t;
using Weights = std::vector<Weight>;

constexpr Weight kUnreachable = RelaxedGraph::kUnreachable;

void lower(Weight value, Weight* weight) { *weight = std::min(*weight, value); }

/// Lowers each of `targets` to `start` and what leads on from there.
void lowerAll(Weight start, const Weight* onward, std::size_t count, Weight* targets) {
  for (std::size_t i = 0; i < count; ++i) targets[i] = std::min(targets[i], start + onward[i]);
}

/// The least sum of two that belong together.
Weight leastSum(const Weight* a, const Weight* b, std::size_t count) {
  Weight least = kUnreachable;
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, a[i] + b[i]);
  return least;
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
        down_(supernodes_.cells(), kUnreachable) {}

  void build() {
    setWeights();
    for (const Supernode& own : supernodes_.all()) {
      lowerInside(own);
      lowerAbove(own);
    }
    const std::vector<Supernode>& all = supernodes_.all();
    for (auto own = all.rbegin(); own != all.rend(); ++own) dropDetours(*own);
    store();
  }

 private:
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
      const Weight *up = &up_[own.rows + below * width], *down = &down_[own.rows + below * width];
      for (std::size_t i = below + 1; i < own.count; ++i) {
        const std::size_t row = own.rows + i * width;
        lowerAll(down[i], up + i + 1, width - i - 1, up_.data() + row + i + 1);
        lowerAll(up[i], down + i + 1, width - i - 1, down_.data() + row + i + 1);
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
                       lowerAll(down_[row + column], &up_[row + column] + 1, rest, way_up_.data());
                       lowerAll(up_[row + column], &down_[row + column] + 1, rest, way_down_.data());
                     }
                     const std::size_t row = upper.row(node);
                     for (std::size_t k = 0; k < rest; ++k) {
                       lower(way_up_[k], &up_[row + columns[i + 1 + k]]);
                       lower(way_down_[k], &down_[row + columns[i + 1 + k]]);
                     }
                   });
  }

  /// Keeps the arcs of a supernode that are shorter than any way over a node above their lower end; then their weights
  /// become those of the shortest ways.
  void dropDetours(const Supernode& own) {
    const std::size_t width = own.width();
    detour_up_.assign(own.count * width, kUnreachable);
    detour_down_.assign(own.count * width, kUnreachable);
    columns_.visit(supernodes_, own,
                   [&](std::uint32_t node, const Supernode& upper, std::size_t i, const auto& columns) {
                     const std::size_t rest = own.above.size() - i - 1, row = upper.row(node);
                     way_up_.resize(rest);
                     way_down_.resize(rest);
                     for (std::size_t k = 0; k < rest; ++k) {
                       way_up_[k] = up_[row + columns[i + 1 + k]];
                       way_down_[k] = down_[row + columns[i + 1 + k]];
                     }
                     leaveNothingAtNoCost(&way_up_, &way_down_);
                     for (std::size_t k = 0; k < own.count; ++k)
                       lookForDetours(own, k, own.count + i, way_up_, way_down_);
                   });
    for (std::size_t k = own.count; k-- > 0;) {
      for (std::size_t over = k + 1; over < own.count; ++over) {
        const auto row = static_cast<std::ptrdiff_t>(own.rows + over * width + over + 1);
        const auto end = row + static_cast<std::ptrdiff_t>(width - over - 1);
        way_up_.assign(up_.begin() + row, up_.begin() + end);
        way_down_.assign(down_.begin() + row, down_.begin() + end);
        leaveNothingAtNoCost(&way_up_, &way_down_);
        lookForDetours(own, k, over, way_up_, way_down_);
      }
      keepNeeded(own, k, detour_up_, &up_, &kept_up_);
      keepNeeded(own, k, detour_down_, &down_, &kept_down_);
    }
  }

  /// Of two arcs between whose ends nothing is to be driven one has to stay: neither is a detour of the other.
  static void leaveNothingAtNoCost(Weights* up, Weights* down) {
    for (Weights* weights : {up, down}) {
      for (Weight& weight : *weights) weight = weight > 0 ? weight : kUnreachable;
    }
  }

  /// For the arcs of node `k` of `own`: over the node of column `over`, from which `up` and `down` lead to and from
  /// those of the columns after it.
  void lookForDetours(const Supernode& own, std::size_t k, std::size_t over, const Weights& up, const Weights& down) {
    const std::size_t begin = k * own.width() + over;
    const Weight *own_up = &up_[own.rows + begin], *own_down = &down_[own.rows + begin];
    lowerAll(*own_up, up.data(), up.size(), &detour_up_[begin] + 1);
    lowerAll(*own_down, down.data(), down.size(), &detour_down_[begin] + 1);
    lower(leastSum(own_up + 1, down.data(), down.size()), &detour_up_[begin]);
    lower(leastSum(own_down + 1, up.data(), up.size()), &detour_down_[begin]);
  }

  void keepNeeded(const Supernode& own, std::size_t k, const Weights& detours, Weights* weights,
                  std::vector<std::vector<Arc>>* kept) {
    std::vector<Arc> arcs;
    for (std::size_t column = k + 1; column < own.width(); ++column) {
      Weight& weight = (*weights)[own.rows + k * own.width() + column];
      const Weight detour = detours[k * own.width() + column];
      if (weight < detour) arcs.push_back({own.nodeAt(column), weight});
      lower(detour, &weight);
    }
    kept->push_back(std::move(arcs));
  }

  /// The arcs were kept from the highest node down.
  void store() {
    for (std::uint32_t node = 0; node < supernodes_.size(); ++node) {
      result_.parent_.push_back(supernodes_.parent(node, kNoParent));
    }
    for (auto [kept, first, arcs] : {std::tuple(&kept_up_, &result_.first_up_, &result_.up_),
                                     std::tuple(&kept_down_, &result_.first_down_, &result_.down_)}) {
      std::size_t count = 0;
      for (const std::vector<Arc>& own : *kept) count += own.size();
      arcs->reserve(count);
      first->push_back(0);
      for (auto own = kept->rbegin(); own != kept->rend(); ++own) {
        arcs->insert(arcs->end(), own->begin(), own->end());
        first->push_back(static_cast<std::uint32_t>(arcs->size()));
      }
    }
  }

  const RelaxedGraph& graph_;
  ContractionHierarchy& result_;
  const Supernodes supernodes_;
  Weights up_, down_;
  std::vector<std::vector<Arc>> kept_up_, kept_down_;
  ColumnsAbove columns_;
  Weights way_up_, way_down_, detour_up_, detour_down_;
};

ContractionHierarchy::ContractionHierarchy(const RelaxedGraph& graph) : rank_(graph.size()) {
  const std::vector<LaneIndex> order = eliminationOrder(graph);
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) rank_[order[rank]] = rank;
  Builder(graph, this).build();
}

}  // namespace external_command
