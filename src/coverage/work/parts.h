// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "swaths.h"

namespace external_command {

/// Divides what is not swept yet by straight lines, each along the swaths of one of its sides, as long as swaths in a
/// direction of its own for each part are worth more than one direction for both (as W. Huang, "Optimal
/// line-sweep-based decompositions for coverage algorithms", 2001, but greedily).
/// @return  the parts, or one that holds everything.
std::vector<Part> divided(const Field& field, const SwathPrices& prices, const CoverageGrid& grid);

}  // namespace external_command
