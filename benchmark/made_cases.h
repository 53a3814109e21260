// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "parking_case.h"

namespace external_command {
namespace benchmark {

/// Hard free-space cases by name: slaloms of 4 to 30 gates, car parks of up to 300 m x 250 m with up to 7,000 posts,
/// docks for lorries, alleys, mazes, roads of kilometres, plains, obstacles of thousands of vertices, and gaps that are
/// too narrow. The same for the same seed.
std::vector<ParkingCase> makeParkingCases(unsigned seed);

}  // namespace benchmark
}  // namespace external_command
