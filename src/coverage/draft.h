// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "field.h"
#include "work.h"

namespace external_command {

/// What is to be worked on, in no order yet.
struct Draft {
  std::vector<Work> works;
  double cost = 0.0;  ///< about the length with turns, less the price of what is swept [m]
  int laps = 0;
};

/// Drafts with different numbers of laps, cheapest first.
/// @param price  of a square metre that is not swept [m/m^2].
std::vector<Draft> makeDrafts(const Field& field, double price);

}  // namespace external_command
