// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "motion/footprint_index.h"

namespace external_command {

/// True where no way leads from `from` to `to` inside `area`, where the rear axle stays, since every one of them is
/// somewhere narrower than the disc as wide as the vehicle that every free footprint contains. A proof: the vehicle
/// cannot get there. False proves nothing, and is what comes out once `stop` says so.
bool isTooNarrow(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from, const Pose2d& to,
                 const std::function<bool()>& stop);

/// A place between two obstacles.
struct NarrowPassage {
  double width = 0.0;    ///< from obstacle to obstacle [m]
  double margins = 0.0;  ///< to both of them [m]
  Point2d at{0.0, 0.0};  ///< its middle, in the local frame
};

/// Where the widest way from one pose to another is narrowest; nullopt where obstacles close every way, or once `stop`
/// says so.
std::optional<NarrowPassage> narrowestPassage(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                              const Pose2d& to, const std::function<bool()>& stop);

}  // namespace external_command
