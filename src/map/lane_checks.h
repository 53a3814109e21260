// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/map/map_data.h"
#include "map_content.h"

namespace external_command {

/// Linked lanes whose points all lie within 1 mm, as connecting lanes of some maps do, get a centre line of just over
/// 1 mm in the direction of the lanes they connect, so that they keep their links. Lanes of a single point stay as they
/// are.
void stretchPointLanes(MapData* data, MapFaults* faults);

/// Neighbours in the same direction that the file states on the wrong side change sides; those that run the other way,
/// or lie too far off for a lane change, are dropped.
void mendNeighbours(MapContent* map);

/// Counts driving lanes that run beside another one in the same direction, where no lane of the map has a neighbour.
/// @pre  the tree of `map` is built.
void countMissingNeighbours(MapContent* map);

/// Drops links whose ends lie more than `max_gap` [m] apart, fills in where overlapping lanes are entered, and counts
/// what else is odd about links and centre lines.
void checkLinks(double max_gap, MapContent* map);

/// Adds the other direction of each driving lane of both directions, linked where its ends meet those of lanes that are
/// linked with it, and beside the lanes of its direction.
void addReverseLanes(double max_gap, MapContent* map);

}  // namespace external_command
