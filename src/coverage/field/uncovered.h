// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "grid.h"

namespace external_command {

/// Cells, as column and row, of a connected part of what could be swept but was not.
using UnsweptPart = std::vector<std::pair<int, int>>;

/// Those larger than `least` [m^2].
std::vector<UnsweptPart> unsweptParts(const CoverageGrid& grid, double least);

/// Those of them that hold any of `cells`.
std::vector<UnsweptPart> unsweptParts(const CoverageGrid& grid, double least, const UnsweptPart& cells);

/// Boxes around the larger connected parts of what could be swept but was not, in the frame that `origin` is given in.
std::vector<std::vector<Point2d>> uncoveredParts(const CoverageGrid& grid, const Point2d& origin);

}  // namespace external_command
