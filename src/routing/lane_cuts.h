// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "path_section.h"

namespace external_command {

/// What two sections look at beyond the place where they meet, so that both have the same path there [m].
constexpr double kSectionOverlap = 16.0;

/// Where the path of a lane can be cut: calm places, at which and kSectionOverlap to either side of which its centre
/// line asks nothing of a vehicle. What the path is like there depends on that much of the lane, and on nothing else.
struct LaneCuts {
  std::vector<double> places;  ///< ascending, some 25 m apart [m]
  std::size_t main = 0;        ///< that in the middle of the lane, where there are any
};

LaneCuts laneCuts(const PathMaking& making, LaneIndex lane);

}  // namespace external_command
