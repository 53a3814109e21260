// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "external_command/core/path.h"

namespace external_command {

/// Lowers the speeds of a path to what its steering allows between gear changes. Where the vehicle stops anyway it
/// turns its wheels meanwhile.
inline void limitSteering(const VehicleParams& vehicle, Path* path) {
  for (std::size_t i = 1; i < path->size(); ++i) {
    ReferencePoint &before = (*path)[i - 1], &point = (*path)[i];
    if (before.direction != point.direction) continue;
    const double limit = steeringSpeed(vehicle, before, point);
    before.speed = std::min(before.speed, limit);
    point.speed = std::min(point.speed, limit);
  }
}

}  // namespace external_command
