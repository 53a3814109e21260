// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "lane_cuts.h"

namespace external_command {

using LaneCutsOf = std::function<std::shared_ptr<const LaneCuts>(LaneIndex lane)>;

/// The route in sections that meet at calm places: near its ends and near lane changes at any, else in the middle of
/// the lanes, so that routes over the same lanes have the same sections. A single one where there is no such place.
/// @param merging  behind the start, where the path has yet to get onto the lane [m].
std::vector<PathSection> sectionsOf(const std::vector<RouteRow>& rows, double merging, const LaneCutsOf& cuts_of);

}  // namespace external_command
