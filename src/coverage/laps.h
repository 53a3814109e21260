// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field.h"
#include "grid.h"
#include "work.h"

namespace external_command {

/// Plans lap `number` (0 is the outermost) along the border and the holes, and marks in `grid` what it sweeps.
/// @param around_holes  laps that holes get; beyond those only the border has some.
/// @param price         of a square metre that is not swept [m/m^2].
std::vector<Work> planLap(const Field& field, int number, int around_holes, double price, CoverageGrid* grid);

}  // namespace external_command
