// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lane_graph.h"

namespace external_command {

/// What is left of the rules of routing where black lists, the room of changes and where on a lane they begin are left
/// out: a graph of lanes whose distances are never above what LabelSearch pays. It gives that search its lower bounds.
///
/// A node stands for the end of its lane. Two kinds of arcs lead from it: onto a successor and to its end; and to the
/// neighbour, at the price of a change. A change also counts the metres from where the stretch of road was entered as
/// those of the lane changed to, which may be fewer. So that no arc is negative, of each metre of a lane only the share
/// `rate` is counted, 1 but where lanes abreast differ in length by more than the price.
struct RelaxedGraph {
  static constexpr double kUnitsPerMetre = 256.0;
  static constexpr double kMaxWeight = 10000.0;  ///< so that sums stay in range; a bound may always be lower [m]
  static constexpr std::int32_t kUnreachable = (1 << 30) - 1;  ///< two of them can be added

  struct Arc {
    LaneIndex tail, head;
    std::int32_t weight;  ///< rounded down [1 / kUnitsPerMetre m]
  };

  RelaxedGraph(const LaneGraph& graph, double change_price);

  std::size_t size() const { return rates.size(); }

  std::vector<double> rates;     ///< in [0, 1]
  std::vector<Arc> arcs;         ///< those of links, then those of changes
  std::size_t first_change = 0;  ///< in `arcs`
};

}  // namespace external_command
