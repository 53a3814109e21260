// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "distance_map.h"

namespace external_command {

/// Why a body like the vehicle cannot get from one pose to another.
struct TightTurn {
  /// By which its heading is off at least, at one of the two poses if it comes from the other; nullopt where it cannot
  /// even get to the place [rad].
  std::optional<double> heading_off;
};

/// Past the obstacles to either of two poses; they say where to look first.
struct WayMaps {
  const DistanceMap& to_first;
  const DistanceMap& to_last;
};

/// Whether a body that is as long and as wide as the vehicle gets from pose to pose inside `area`, if it may move
/// sideways and turn on the spot: floods from both over cells of position and heading, of which only those are left out
/// in which no pose is free. So what comes out is a proof that the vehicle cannot, either; nullopt proves nothing, and
/// is what comes out once `stop` says so. In wide areas the cells are large, and proofs rare.
std::optional<TightTurn> tightTurn(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                   const Pose2d& to, const WayMaps& ways, const std::function<bool()>& stop);

}  // namespace external_command
