// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/routing/router.h"

namespace external_command {

/// Where lanes give access to an area: by the map's overlaps, else the nearest point of each drivable lane that comes
/// within `max_distance` [m] of the area's border.
/// @throws OffMap  no lane does; the text names the area.
std::vector<LanePoint> accessPoints(const HdMap& map, const Area& area, double max_distance);

}  // namespace external_command
