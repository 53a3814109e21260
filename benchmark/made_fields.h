// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage_case.h"

namespace external_command {
namespace benchmark {

/// Rectangles, L, U, rings, fields with columns, walls or a narrow neck, then `random` concave ones with holes and
/// pillars; 60 m to 1 km across, each with a free start. The same for the same seed.
std::vector<CoverageCase> makeFields(unsigned seed, int random);

}  // namespace benchmark
}  // namespace external_command
