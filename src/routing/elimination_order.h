// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "relaxed_graph.h"

namespace external_command {

/// In which order a contraction hierarchy takes the lanes out of the graph, so that few arcs have to be added: first
/// those that link no more than two others, as most lanes of junctions do; then the rest by nested dissection (METIS),
/// with lanes abreast taken as one.
std::vector<LaneIndex> eliminationOrder(const RelaxedGraph& graph);

}  // namespace external_command
