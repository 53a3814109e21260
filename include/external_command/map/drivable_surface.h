// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/polygon.h"
#include "external_command/map/hd_map.h"

namespace external_command {

/// A part of the plane with one outline.
struct Surface {
  Polygon outer;
  std::vector<Polygon> holes;
};

struct SurfaceParams {
  double radius = 25.0;      ///< around `center`, lanes are part of the surface [m]
  double gap = 0.3;          ///< by which lanes are widened on either side within `gap_radius` of `center` [m]
  double gap_radius = 10.0;  ///< [m]
};

/// `core` (a parking space, an area) together with the drivable lanes around `center`: where a vehicle may manoeuvre
/// between the lanes and `core`. Lanes that do not connect to `core` are left out.
/// A lane's surface is its centre line widened by half its width to both sides, and by a little more, so that lanes
/// that only touch connect.
/// @throws Cancelled  `cancel` was raised; looked at after each lane.
Surface drivableSurface(const HdMap& map, const Polygon& core, const Point2d& center, const SurfaceParams& params,
                        const CancelToken& cancel = {});

}  // namespace external_command
