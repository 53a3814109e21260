// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_content.h"

namespace external_command {

/// The heading in which a vehicle parked nose in points, from the shape of the space: along its longer side, away from
/// the nearest drivable lane; with the traffic where the space lies along the lane.
double derivedParkingHeading(const MapContent& map, const Polygon& space);

/// True for a stated heading of more than a full turn that, as one in degrees, lies more exactly along or across the
/// space than as one in radians.
bool isInDegrees(const Polygon& space, double heading);

/// Puts four corners that were drawn crosswise in order around their middle; false where there is nothing to put right,
/// or no telling how.
bool putInOrder(std::vector<Point2d>* corners);

/// False where a vehicle with this heading would stand across a space that is clearly longer than it is wide. Maps
/// exported from simulators state the direction of the lane for spaces perpendicular to it.
bool fitsParkingSpace(const Polygon& space, double heading);

}  // namespace external_command
