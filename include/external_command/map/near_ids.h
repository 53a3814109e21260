// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "external_command/map/hd_map.h"

namespace external_command {

/// For the end of an error text about an id that the map does not have: "; did you mean 'n_out_5'?" where an id of the
/// same kind is like it, else empty. O(letters of all ids).
std::string nearLaneIds(const HdMap& map, const std::string& id);
std::string nearRoadIds(const HdMap& map, const std::string& id);
std::string nearParkingSpaceIds(const HdMap& map, const std::string& id);
std::string nearAreaIds(const HdMap& map, const std::string& id);

}  // namespace external_command
