// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "external_command/map/hd_map.h"
#include "map_faults.h"

namespace external_command {

/// What is made of a lane by itself.
struct LaneShape {
  Polyline center;
  std::vector<HeightSample> heights;
};

/// A map without heights states 0 throughout.
bool hasHeights(const LaneData& lane);

/// Takes the centre line out of `lane`, and what is out of range from the rest of it.
/// @param has_heights  of any lane of the map.
/// @return  nullopt where the lane cannot be used at all.
std::optional<LaneShape> cleanLane(const MapParams& params, bool has_heights, LaneData* lane, MapFaults* faults);

}  // namespace external_command
