// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "motion/footprint_index.h"

namespace external_command {

/// Why a body like the vehicle cannot get from one pose to another.
struct TightTurn {
  /// By which its heading is off at least where it has to go; nullopt where it cannot get there at all [rad].
  std::optional<double> heading_off;
};

/// Whether a body that is as long and as wide as the vehicle gets from pose to pose inside `area`, if it may move
/// sideways and turn on the spot: a flood over cells of position and heading, of which only those are left out in which
/// no pose is free. So what comes out is a proof that the vehicle cannot, either; nullopt proves nothing, and is what
/// comes out once `stop` says so. In wide areas the cells are large, and proofs rare.
std::optional<TightTurn> tightTurn(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                   const Pose2d& to, const std::function<bool()>& stop);

}  // namespace external_command
