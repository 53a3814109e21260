// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "ompl/first_path.h"

namespace external_command {

/// Ways out of a pose close beside an obstacle, where tail or nose would swing into it at full lock: in one gear, to
/// one side, with a curvature that grows as they draw away from it. Each ends where full lock can be driven. Shortest
/// first; empty where full lock can be driven at once, or where there are none.
std::vector<Arcs> pullAways(const Scene& scene, const Pose2d& from);

/// As findFirstPath() with the planner's own search, which knows no other curves than full lock: from an end close
/// beside an obstacle it may find a dear way, or none. There it also begins at the ends of pullAways(), with few steps
/// as long as there is another way. The last path tells how it ended.
std::vector<FirstPath> findFirstPaths(const Scene& scene, const Query& query, const BoundingBox& area,
                                      const FirstPathRequest& request, const StopCondition& stop);

}  // namespace external_command
