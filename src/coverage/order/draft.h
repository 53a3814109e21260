// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "coverage/work/swaths.h"
#include "coverage/work/work.h"

namespace external_command {

/// What is to be worked on, in no order yet: so and so many laps, then swaths for the rest.
struct Draft {
  int laps = 0;
  double swing = 0.0;                  ///< as LapRule::swing [m]
  double cost = 0.0;                   ///< about the length with turns, less the price of what is swept [m]
  std::vector<Work> works;             ///< the laps
  CoverageGrid grid;                   ///< what they sweep
  std::vector<SwathHeading> headings;  ///< of the swaths, best first
};

/// Drafts with the numbers of laps that look best, cheapest first, at most `count` for each swing, in turn.
/// @param price  of a square metre that is not swept [m/m^2].
std::vector<Draft> makeDrafts(const Field& field, const CoverageGrid& empty, double price, std::size_t count);

/// Laps from the border inwards until none fits, and one around each hole: what sweeps rings and corridors with hardly
/// a turn. None for areas that are wide, or for which a number of laps is given.
std::vector<Draft> draftsOfLaps(const Field& field, const CoverageGrid& empty, double price);

/// The draft's laps, and its swaths.
/// @param choosy  how much dearer than really the turns are taken to be: only long swaths are worth it then, and what
///                they leave can be swept in another direction.
std::vector<Work> worksOf(const Field& field, Draft draft, double price, double choosy);

/// Parts of what the draft's laps leave that are better swept in directions of their own; one where that does not pay.
std::vector<Part> partsOf(const Field& field, const Draft& draft, double price);

/// The draft's laps, and the swaths of each part.
std::vector<Work> worksOf(const Field& field, Draft draft, double price, const std::vector<Part>& parts);

}  // namespace external_command
