// SPDX-License-Identifier: Apache-2.0
#include "elimination_order.h"

#include <metis.h>

#include <algorithm>
#include <numeric>

#include "external_command/core/error.h"

namespace external_command {

namespace {

constexpr std::size_t kFewLinks = 2;

using Adjacency = std::vector<std::vector<LaneIndex>>;

Adjacency undirected(const RelaxedGraph& graph) {
  Adjacency linked(graph.size());
  for (const RelaxedGraph::Arc& arc : graph.arcs) {
    if (arc.tail == arc.head) continue;
    linked[arc.tail].push_back(arc.head);
    linked[arc.head].push_back(arc.tail);
  }
  for (std::vector<LaneIndex>& others : linked) {
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
  }
  return linked;
}

void insertSorted(LaneIndex lane, std::vector<LaneIndex>* lanes) {
  const auto at = std::lower_bound(lanes->begin(), lanes->end(), lane);
  if (at == lanes->end() || *at != lane) lanes->insert(at, lane);
}

void eraseSorted(LaneIndex lane, std::vector<LaneIndex>* lanes) {
  lanes->erase(std::lower_bound(lanes->begin(), lanes->end(), lane));
}

/// Takes lanes with few links out, and links what they linked.
/// @return them, in that order.
std::vector<LaneIndex> takeOutSimpleLanes(Adjacency* linked) {
  std::vector<LaneIndex> order;
  std::vector<bool> is_out(linked->size(), false);
  std::vector<LaneIndex> waiting(linked->size());
  std::iota(waiting.rbegin(), waiting.rend(), 0);
  while (!waiting.empty()) {
    const LaneIndex lane = waiting.back();
    waiting.pop_back();
    if (is_out[lane] || (*linked)[lane].size() > kFewLinks) continue;
    is_out[lane] = true;
    order.push_back(lane);
    const std::vector<LaneIndex> others = std::move((*linked)[lane]);
    (*linked)[lane].clear();
    for (const LaneIndex other : others) eraseSorted(lane, &(*linked)[other]);
    if (others.size() == 2) {
      insertSorted(others[0], &(*linked)[others[1]]);
      insertSorted(others[1], &(*linked)[others[0]]);
    }
    waiting.insert(waiting.end(), others.begin(), others.end());
  }
  return order;
}

/// Lanes between which one can change, directly or over others: which group each is of.
class Groups {
 public:
  explicit Groups(const RelaxedGraph& graph) : first_(graph.size()) {
    std::iota(first_.begin(), first_.end(), 0);
    for (std::size_t i = graph.first_change; i < graph.arcs.size(); ++i) {
      first_[of(graph.arcs[i].tail)] = of(graph.arcs[i].head);
    }
  }

  LaneIndex of(LaneIndex lane) {
    while (first_[lane] != lane) lane = first_[lane] = first_[first_[lane]];
    return lane;
  }

 private:
  std::vector<LaneIndex> first_;
};

/// The groups of lanes that are left, as METIS wants them.
struct GroupGraph {
  std::vector<std::vector<LaneIndex>> lanes;
  std::vector<idx_t> first, linked, sizes;
};

GroupGraph groupGraph(const Adjacency& linked, Groups* groups) {
  constexpr idx_t kNone = -1;
  GroupGraph graph;
  std::vector<idx_t> number(linked.size(), kNone);
  for (LaneIndex lane = 0; lane < linked.size(); ++lane) {
    if (linked[lane].empty()) continue;
    idx_t& group = number[groups->of(lane)];
    if (group == kNone) {
      group = static_cast<idx_t>(graph.lanes.size());
      graph.lanes.emplace_back();
    }
    graph.lanes[static_cast<std::size_t>(group)].push_back(lane);
  }
  for (const std::vector<LaneIndex>& lanes : graph.lanes) {
    graph.first.push_back(static_cast<idx_t>(graph.linked.size()));
    graph.sizes.push_back(static_cast<idx_t>(lanes.size()));
    const idx_t own = number[groups->of(lanes.front())];
    std::vector<idx_t> others;
    for (const LaneIndex lane : lanes) {
      for (const LaneIndex other : linked[lane]) others.push_back(number[groups->of(other)]);
    }
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    std::copy_if(others.begin(), others.end(), std::back_inserter(graph.linked), [own](idx_t o) { return o != own; });
  }
  graph.first.push_back(static_cast<idx_t>(graph.linked.size()));
  return graph;
}

/// Not METIS_NodeND, which is the same but takes over the process's SIGTERM while it runs.
std::vector<idx_t> nestedDissection(GroupGraph* graph) {
  const auto count = static_cast<idx_t>(graph->lanes.size());
  std::vector<idx_t> order(graph->lanes.size()), place(graph->lanes.size());
  if (graph->linked.empty()) {
    std::iota(order.begin(), order.end(), 0);
    return order;
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_COMPRESS] = 0;
  options[METIS_OPTION_SEED] = 1;
  constexpr idx_t kParts = 2;
  idx_t part_sizes[2 * kParts];
  const int status = METIS_NodeNDP(count, graph->first.data(), graph->linked.data(), graph->sizes.data(), kParts,
                                   options, order.data(), place.data(), part_sizes);
  if (status != METIS_OK) throw InternalError("METIS could not order the lanes of the map");
  return order;
}

}  // namespace

std::vector<LaneIndex> eliminationOrder(const RelaxedGraph& graph) {
  Adjacency linked = undirected(graph);
  std::vector<LaneIndex> order = takeOutSimpleLanes(&linked);
  Groups groups(graph);
  GroupGraph rest = groupGraph(linked, &groups);
  for (const idx_t group : nestedDissection(&rest)) {
    const std::vector<LaneIndex>& lanes = rest.lanes[static_cast<std::size_t>(group)];
    order.insert(order.end(), lanes.begin(), lanes.end());
  }
  return order;
}

}  // namespace external_command
