// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "coverage/field/profile.h"
#include "work.h"

namespace external_command {

/// What swaths are chosen by.
struct SwathPrices {
  double unswept = 0.0;  ///< of a square metre that is not swept [m/m^2]
  double turn = 0.0;     ///< of going from one swath to the next [m]
};

/// A direction of the swaths, and about what they are worth then, from a coarse look [m].
struct SwathHeading {
  double heading = 0.0;
  double worth = 0.0;
};

/// Every direction worth a thought: those of the border's edges, and some all round.
std::vector<double> swathHeadings(const Field& field);

/// `headings` for what is not swept in `grid` and lies in `part`, best first.
std::vector<SwathHeading> rankHeadings(const Field& field, const SwathPrices& prices, const CoverageGrid& grid,
                                       const std::vector<double>& headings, const Part& part = {});

/// Swaths for what is not swept yet in `part`, all in one of the first few `headings`, that are the best bargain:
/// straight, but for small obstacles that they are bent round. Marks in `grid` what they sweep.
std::vector<Work> planSwaths(const Field& field, const SwathPrices& prices, const std::vector<SwathHeading>& headings,
                             CoverageGrid* grid, const Part& part = {});

}  // namespace external_command
