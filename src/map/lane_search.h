// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "map_content.h"

namespace external_command {

/// As the functions of HdMap of the same names.
std::optional<LaneMatch> nearestLane(const MapContent& map, const Point2d& point, const LaneQuery& query);
std::vector<LaneMatch> lanesWithin(const MapContent& map, const Point2d& point, const LaneQuery& query);

/// Those of `lanes` that satisfy `query`, drivable or not, as lanesWithin() has them.
std::vector<LaneMatch> matchesOf(const MapContent& map, std::vector<LaneIndex> lanes, const Point2d& point,
                                 const LaneQuery& query);

}  // namespace external_command
