// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage/field/field.h"

namespace external_command {

/// Part of a straight line where the vehicle does not fit, and how far beside the line it does. Distances of the rear
/// axle along the line, driven forward [m].
struct Bay {
  double from = 0.0;   ///< -infinity where it is not known to end
  double to = 0.0;     ///< likewise, infinity
  double shift = 0.0;  ///< positive to the left; 0: nowhere near enough

  bool isPassable() const { return shift != 0.0; }
};

/// The pose `along` [m] ahead of `start`, and `aside` [m] of the line, positive to the left.
Pose2d placeBeside(const Pose2d& start, double along, double aside);

/// The bays of the line from `start` on for `length` [m], and of so much before it as a vehicle has to know that
/// drives it from the other end. Those with no room in between to get from one to the other are one.
/// @param step  between places that are looked at [m].
std::vector<Bay> baysOf(const Field& field, const Pose2d& start, double length, double step);

}  // namespace external_command
