// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "external_command/core/vehicle.h"
#include "external_command/map/hd_map.h"

namespace external_command {

struct MapCheckParams {
  VehicleParams vehicle;
  double max_link_gap = MapParams().max_link_gap;  ///< as map/max_link_gap of the gateway [m]
};

struct MapReport {
  std::shared_ptr<const HdMap> map;
  std::vector<MapFinding> findings;  ///< errors first, then by kind, in the order they were found
  std::vector<std::string> notes;    ///< what could not be judged, and why
};

/// All that the reader of maps finds wrong, which the gateway counts in its log, and what only a look at the map as a
/// whole, at what the file states twice, or at the vehicle shows. What concerns nothing but lanes that nobody drives on
/// is a warning. O(n log n).
/// @throws MapError  there is no lane to be used.
MapReport checkMap(const MapData& data, const MapCheckParams& params);

}  // namespace external_command
