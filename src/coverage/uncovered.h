// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "grid.h"

namespace external_command {

/// Boxes around the larger connected parts of what could be swept but was not, in the frame that `origin` is given in.
std::vector<std::vector<Point2d>> uncoveredParts(const CoverageGrid& grid, const Point2d& origin);

}  // namespace external_command
