// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "external_command/core/cancel_token.h"
#include "external_command/routing/router.h"
#include "lane_graph.h"

namespace external_command {

/// Why `query` has no route, for a person: which leg, what was tried, and what would have to change.
std::string whyNoRoute(const HdMap& map, const LaneGraph& graph, const RouterParams& params, const RouteQuery& query,
                       const CancelToken& cancel);

}  // namespace external_command
