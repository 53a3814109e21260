// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "map_content.h"

namespace external_command {

/// The heading in which a vehicle parked nose in points, from the shape of the space: along its longer side, away from
/// the nearest drivable lane; with the traffic where the space lies along the lane.
double derivedParkingHeading(const MapContent& map, const Polygon& space);

/// False where a vehicle with this heading would stand across a space that is clearly longer than it is wide. Maps
/// exported from simulators state the direction of the lane for spaces perpendicular to it.
bool fitsParkingSpace(const Polygon& space, double heading);

}  // namespace external_command
