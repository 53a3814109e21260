// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/map/map_data.h"
#include "map_content.h"

namespace external_command {

/// Everything the constructor of HdMap promises.
/// @throws MapError  as that constructor.
MapContent resolve(MapData data, const Point2d& origin, const MapParams& params);

/// The lanes of `data`, moved out of it, with their references; fills `lanes`, `lane_by_id`, `lanes_of_road`.
void resolveLanes(MapData* data, const MapParams& params, MapContent* map);

/// Junctions, parking spaces and areas with the lanes that overlap them; fills in the lanes' `junction_id` where only
/// an overlap tells it. Needs the lanes and their tree.
/// @throws MapError  the overlaps give objects far more lanes than they name.
void resolveObjects(MapData* data, MapContent* map);

}  // namespace external_command
