// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "map_check.h"

namespace external_command {

/// Draws the map with what was found as an SVG: lanes, spaces, areas and junctions, and a mark at each place, which
/// tells what it is where the pointer rests on it.
/// @throws MapError  the file cannot be written.
void drawMap(const MapReport& report, const std::string& file);

}  // namespace external_command
