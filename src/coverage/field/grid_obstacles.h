// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/polygon.h"
#include "external_command/motion/region.h"
#include "geometry.h"

namespace external_command {

/// Outlines of the cells near `within` that are obstacles, and what lies beyond the grid where that is: a little larger
/// than the cells, so that they can be simple, and without free room that is too small for a vehicle. They may touch.
/// @param max_rows  of blocked cells side by side: bounds the memory.
/// @throws InvalidRequest  there are more, or the grid's size and cells do not agree.
std::vector<Polygon> gridObstacles(const OccupancyGrid& grid, const Polygon& within, std::size_t max_rows,
                                   const Checkpoint& checkpoint);

}  // namespace external_command
