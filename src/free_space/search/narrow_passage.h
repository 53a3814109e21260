// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "motion/footprint_index.h"

namespace external_command {

/// True where no way for the rear axle leads from `from` to `to` inside `area`, since every one of them is somewhere
/// narrower than the disc around that axle which every free footprint contains. A proof: the vehicle cannot get there.
/// False proves nothing, and is what comes out once `stop` says so.
bool isTooNarrow(const FootprintIndex& index, const BoundingBox& area, const Point2d& from, const Point2d& to,
                 const std::function<bool()>& stop);

/// A place between two obstacles.
struct NarrowPassage {
  double width = 0.0;    ///< from obstacle to obstacle [m]
  Point2d at{0.0, 0.0};  ///< its middle, in the local frame
};

/// Where the widest way from one point to another is narrowest; nullopt where obstacles close every way, or once `stop`
/// says so.
std::optional<NarrowPassage> narrowestPassage(const FootprintIndex& index, const BoundingBox& area, const Point2d& from,
                                              const Point2d& to, const std::function<bool()>& stop);

}  // namespace external_command
