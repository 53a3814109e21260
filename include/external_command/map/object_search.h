// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "external_command/map/hd_map.h"

namespace external_command {

/// What commands can name.
enum class MapObjectKind { kLane, kRoad, kParkingSpace, kArea };

struct ObjectQuery {
  std::optional<MapObjectKind> kind;  ///< nullopt: any
  std::string id;                     ///< empty: any
  std::optional<Point2d> near;        ///< the nearest first; nullopt: in the order of their ids
  std::optional<double> radius;       ///< nothing further from `near` [m]; nullopt: no limit
  std::size_t max_count = 100;
};

struct FoundObject {
  MapObjectKind kind = MapObjectKind::kLane;
  std::string id;
  Pose2d pose;                   ///< lane, road: the point nearest to `near`; else the middle
  bool has_heading = false;      ///< an area has none
  std::optional<double> height;  ///< of a lane at `pose`, where the map gives it [m]
  double distance = 0.0;         ///< of a lane or road to the centre line; of the others to the border, 0 inside [m]
  double length = 0.0;           ///< of a lane along its centre line; of a parking space its longer side [m]
  double width = 0.0;            ///< of a lane at `pose`; of a parking space its shorter side [m]
  std::vector<std::string> lane_ids;  ///< of a road its lanes; of a parking space those it overlaps; else empty
  std::optional<LaneIndex> lane;      ///< that `pose` lies on
  const Polygon* polygon = nullptr;   ///< of a parking space or area; lives as long as the map
};

struct FoundObjects {
  std::vector<FoundObject> objects;  ///< `max_count` at most
  std::size_t total = 0;             ///< that match
};

/// O(n log n) of those within the radius; without one, or without a point, O(n). Of lanes of both directions there is
/// the one that runs along the file's centre line.
/// @throws UnknownId       the map has no such id of that kind; the text tells those that are like it.
/// @throws InvalidRequest  point or radius is no number, or negative.
FoundObjects findObjects(const HdMap& map, const ObjectQuery& query);

/// "parking space" for example.
const char* nameOf(MapObjectKind kind);

}  // namespace external_command
