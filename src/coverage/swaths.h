// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field.h"
#include "grid.h"
#include "work.h"

namespace external_command {

/// Straight swaths for what is not swept yet.
struct SwathPlan {
  double worth = 0.0;  ///< price of what they sweep, less their length and turns [m]
  std::vector<Work> works;
};

/// The swaths, all in one direction, that are the best bargain. Marks in `grid` what they sweep.
/// @param price       of a square metre that is not swept [m/m^2].
/// @param turn_price  of going from one swath to the next [m].
SwathPlan planSwaths(const Field& field, double price, double turn_price, CoverageGrid* grid);

}  // namespace external_command
