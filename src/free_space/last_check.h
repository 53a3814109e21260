// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "external_command/core/path.h"
#include "motion/footprint_index.h"

namespace external_command {

/// What a finished path must fulfil.
struct PathDemands {
  Pose2d start;
  Pose2d goal;
  double max_kappa;  ///< [1/m]
  double spacing;    ///< [m]
};

/// The verdict on a path.
struct LastCheck {
  std::optional<std::string> fault;  ///< what is wrong, where and by how much
  double min_clearance = 0.0;        ///< of the bare footprint, at most 10 m [m]
  double min_room = 0.0;             ///< smallest difference of clearance and margin [m]
};

/// Looks at the points of a path (local frame) as a follower would drive them, one arc from each to the next, and
/// measures its distance to all obstacles, edge by edge. Neither the search nor the cells of `index` are asked.
LastCheck checkPath(const Path& path, const PathDemands& demands, const FootprintIndex& index);

}  // namespace external_command
