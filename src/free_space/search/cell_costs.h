// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "cell_grid.h"

namespace external_command {

/// Of a way from cell to cell: a step costs the price of the cell that it leaves, times 5 straight on, 7 across.
using CellCost = std::uint64_t;
constexpr CellCost kStraightStep = 5, kAcrossStep = 7;
constexpr CellCost kUnreachedCell = std::numeric_limits<CellCost>::max();

/// The cost of the cheapest way from each cell to `target`, by Dijkstra's search.
/// @param prices  of each cell; 0 for those that cannot be left. Few are above 10.
/// @param stop    asked with each cell whose cost is known, cheapest first; once it says so, the costs of the others
///                are not known.
std::vector<CellCost> costsTo(const CellGrid& grid, const std::vector<std::uint16_t>& prices, long target,
                              const std::function<bool(long cell)>& stop);

}  // namespace external_command
