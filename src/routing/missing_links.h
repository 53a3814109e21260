// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "external_command/core/cancel_token.h"
#include "external_command/routing/router.h"
#include "lane_graph.h"

namespace external_command {

/// What the map would have to say for `goals` to be reached from `starts`, whatever room and black list: a link between
/// ends that touch, a smaller gap, a line that may be crossed. O(lanes of the map).
/// @return for the end of an error text, "; lane a ends where lane b begins ..."; empty where nothing is near.
std::string missingLink(const HdMap& map, const LaneGraph& graph, const std::vector<LanePoint>& starts,
                        const std::vector<LanePoint>& goals, const CancelToken& cancel);

}  // namespace external_command
