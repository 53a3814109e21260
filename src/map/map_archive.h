// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/block_file.h"
#include "map_content.h"

namespace external_command {

/// Writes what an HdMap holds; findings are left out.
void writeMapContent(const MapContent& map, BlockWriter* out);

/// Reads what writeMapContent() has written.
/// @param map  is complete once `in->finish()` and then fillTables() were called; must stay in its place until then.
void readMapContentLater(BlockReader* in, MapContent* map);

/// Makes the look-up tables of a map by the ids of its objects.
void fillTables(MapContent* map);

/// Changes with the size of what is written as it is in memory.
std::string mapArchiveLayout();

}  // namespace external_command
