// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "free_space/search/staged_search.h"
#include "free_space/stop_condition.h"

namespace external_command {

/// How to look for a first path, and for how long.
struct FirstPathRequest {
  std::string planner;  ///< see FreeSpaceParams
  std::size_t max_steps = 0;
  std::uint64_t seed = 1;
};

/// Names of the OMPL planners that findFirstPath() knows, besides our own.
const std::vector<std::string>& omplPlannerNames();

/// Runs the planner in OMPL's frame. Paths of OMPL's own planners are simplified by OMPL.
FirstPath findFirstPath(const Scene& scene, const Query& query, const BoundingBox& area,
                        const FirstPathRequest& request, const StopCondition& stop);

}  // namespace external_command
