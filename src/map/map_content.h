// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "external_command/map/hd_map.h"
#include "lane_tree.h"
#include "map_faults.h"

namespace external_command {

/// What an HdMap holds. The keys of the look-up tables are views of the objects' own ids, so a
/// MapContent may be moved but not copied.
struct MapContent {
  explicit MapContent(bool keeps_findings) : faults(keeps_findings) {}
  MapContent(MapContent&&) = default;
  MapContent& operator=(MapContent&&) = delete;

  MapFaults faults;               ///< while it is resolved; `warnings` and `findings` hold what came of it
  std::uint64_t file_digest = 0;  ///< contentDigest() of the file; 0 where it was made of something else
  std::string version;
  std::string projection;
  Point2d origin = Point2d::Zero();
  BoundingBox box;
  std::vector<Lane> lanes;
  LaneTree tree;
  std::vector<Junction> junctions;
  std::vector<ParkingSpace> parking_spaces;
  std::vector<Area> areas;
  std::vector<MapWarning> warnings;
  std::vector<MapFinding> findings;
  std::vector<BrokenLink> broken_links;
  std::unordered_map<std::string, std::string> unusable_parking_spaces;  ///< why, by id

  std::unordered_map<std::string_view, LaneIndex> lane_by_id;
  std::unordered_map<std::string_view, std::size_t> parking_space_by_id;
  std::unordered_map<std::string_view, std::size_t> area_by_id;
  std::unordered_map<std::string, std::vector<LaneIndex>> lanes_of_road;
};

}  // namespace external_command
