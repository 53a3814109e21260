// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/core/path.h"
#include "external_command/routing/router.h"

namespace external_command {

struct ReferencePathParams {
  double spacing = 0.5;               ///< between two points [m]
  double lane_change_length = 30.0;   ///< wished for a smooth change; less where the route leaves less [m]
  double default_speed_limit = 13.9;  ///< where the map gives none [m/s]

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

/// The centre line of the route with its lane changes as smooth transitions (quintic in the lateral offset, so heading
/// and curvature have no step), sampled at `spacing`; the last point lies exactly on the route's end. Speeds are
/// caps, see limitSpeeds(): the lanes' limits, lowered to `target_speed` (0: not given).
Path referencePath(const HdMap& map, const Route& route, const VehicleParams& vehicle,
                   const ReferencePathParams& params, double target_speed);

}  // namespace external_command
