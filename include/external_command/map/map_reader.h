// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "external_command/map/hd_map.h"

namespace external_command {

/// What to subtract from a map's coordinates.
struct MapOrigin {
  enum class Kind { kNone, kAuto, kGiven };
  Kind kind = Kind::kNone;
  Point2d point = Point2d::Zero();  ///< of kGiven [m]
};

/// Reads Apollo's base_map / sim_map, binary or protobuf text (told apart by content, not by name).
/// kAuto takes the centre of the lanes' bounding box, rounded to whole metres.
/// @throws MapError  the file is missing, empty, truncated, not a map, or one that HdMap refuses; the text names the
/// file.
std::shared_ptr<const HdMap> readMap(const std::string& file, const MapOrigin& origin, const MapParams& params = {});

/// The same, but only what the file states.
MapData readMapData(const std::string& file);

}  // namespace external_command
