// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/polygon.h"
#include "external_command/free_space/region.h"

namespace external_command {

/// Outlines of the occupied cells near `within`, without the holes in them: a little larger than the cells, so that
/// they can be simple.
std::vector<Polygon> gridObstacles(const OccupancyGrid& grid, const Polygon& within);

}  // namespace external_command
