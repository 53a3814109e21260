// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "external_command/motion/collision_checker.h"
#include "footprint_index.h"

namespace external_command {

/// What error texts call an obstacle of a region, see Collision::obstacle.
std::string obstacleName(const Region& region, int source);

/// The deepest collision at a pose of the local frame, with its point in the map frame; nullopt exactly where the pose
/// is free. Slow and plain: all edges of every obstacle are looked at.
std::optional<Collision> probeCollision(const FootprintIndex& index, const Pose2d& local);

}  // namespace external_command
