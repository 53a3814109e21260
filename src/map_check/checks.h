// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/vehicle.h"
#include "external_command/map/hd_map.h"
#include "map/map_faults.h"

namespace external_command {

/// What the checks look at: the map as it is used, and as the file states it; and where they put what they find.
struct MapUnderCheck {
  const HdMap& map;
  const MapData& stated;
  const VehicleParams& vehicle;
  MapFaults* faults;
  std::vector<std::string>* notes;
};

/// Lanes by themselves: widths and boundaries, speed limits, stated direction.
void checkLaneShapes(const MapUnderCheck& check);

/// What a file states twice: links and neighbours of one side only, ids, lanes of roads and junctions.
void checkReferences(const MapUnderCheck& check);

/// Ends that touch without a link, and links between lanes of different heights.
void checkJoints(const MapUnderCheck& check);

/// Lanes that no route leads onto or away from.
void checkReach(const MapUnderCheck& check);

/// Where overlaps say that lanes and objects meet.
void checkOverlaps(const MapUnderCheck& check);

/// Whether the vehicle gets to each parking space, and fits in.
void checkSpaces(const MapUnderCheck& check);

}  // namespace external_command
