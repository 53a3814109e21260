// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "work.h"

namespace external_command {

/// How laps along the border go with those around holes.
struct LapRule {
  int around_holes = 0;   ///< laps that each hole gets but the small ones; beyond those only the border has some
  double swing = 0.0;     ///< how much farther than half a swath the outermost lap is from the border [m]
  bool overlaps = false;  ///< those along the border go on where the ones around holes have swept: a strip between both
                          ///< that is narrower than a lap is swept too
};

/// Distances worth a try as LapRule::swing: none; and where the vehicle is not to reverse, so much that the nose gets
/// round a corner that is as tight as the vehicle can turn.
std::vector<double> swingsOf(const Field& field);

/// Plans lap `number` (0 is the outermost) along the border and the holes of Field::passable(), past small ones, and
/// marks in `grid` what it sweeps.
/// @param price  of a square metre that is not swept [m/m^2].
std::vector<Work> planLap(const Field& field, int number, const LapRule& rule, double price, CoverageGrid* grid);

}  // namespace external_command
