// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/hd_map.h"

#include <algorithm>

#include "external_command/core/parameter_range.h"
#include "lane_search.h"
#include "map_content.h"
#include "map_resolver.h"

namespace external_command {

namespace {

template <class Table>
auto positionOf(const Table& table, const std::string& id) -> std::optional<typename Table::mapped_type> {
  const auto found = table.find(id);
  if (found == table.end()) return std::nullopt;
  return found->second;
}

}  // namespace

void MapParams::validate() const {
  requireParameter("max_link_gap", max_link_gap, 0.0, 1000.0);
  requireParameter("max_segment_length", max_segment_length, 1.0, 1e6);
}

HdMap::HdMap(MapData data, const Point2d& origin, const MapParams& params)
    : HdMap(resolve(std::move(data), origin, params)) {}

HdMap::HdMap(MapContent content) : content_(std::make_unique<const MapContent>(std::move(content))) {}

HdMap::~HdMap() = default;

const std::string& HdMap::version() const { return content_->version; }
const std::string& HdMap::projection() const { return content_->projection; }
const Point2d& HdMap::origin() const { return content_->origin; }
const BoundingBox& HdMap::box() const { return content_->box; }
const std::vector<Lane>& HdMap::lanes() const { return content_->lanes; }
const std::vector<Junction>& HdMap::junctions() const { return content_->junctions; }
const std::vector<ParkingSpace>& HdMap::parkingSpaces() const { return content_->parking_spaces; }
const std::vector<Area>& HdMap::areas() const { return content_->areas; }
const std::vector<MapWarning>& HdMap::warnings() const { return content_->warnings; }
const std::vector<MapFinding>& HdMap::findings() const { return content_->findings; }
const std::vector<BrokenLink>& HdMap::brokenLinks() const { return content_->broken_links; }

std::optional<LaneIndex> HdMap::findLane(const std::string& id) const { return positionOf(content_->lane_by_id, id); }

const ParkingSpace* HdMap::findParkingSpace(const std::string& id) const {
  const auto position = positionOf(content_->parking_space_by_id, id);
  return position ? &parkingSpaces()[*position] : nullptr;
}

std::string HdMap::whyUnusable(const std::string& parking_space_id) const {
  const auto found = content_->unusable_parking_spaces.find(parking_space_id);
  return found == content_->unusable_parking_spaces.end() ? "" : found->second;
}

const Area* HdMap::findArea(const std::string& id) const {
  const auto position = positionOf(content_->area_by_id, id);
  return position ? &areas()[*position] : nullptr;
}

std::vector<LaneIndex> HdMap::lanesOfRoad(const std::string& road_id) const {
  return positionOf(content_->lanes_of_road, road_id).value_or(std::vector<LaneIndex>());
}

bool HdMap::hasRoad(const std::string& road_id) const { return content_->lanes_of_road.count(road_id) > 0; }

std::optional<LaneMatch> HdMap::nearestLane(const Point2d& point, const LaneQuery& query) const {
  return external_command::nearestLane(*content_, point, query);
}

std::vector<LaneMatch> HdMap::lanesWithin(const Point2d& point, const LaneQuery& query) const {
  return external_command::lanesWithin(*content_, point, query);
}

const Area* HdMap::areaAt(const Point2d& point) const {
  const auto found =
      std::find_if(areas().begin(), areas().end(), [&](const Area& area) { return area.polygon.contains(point); });
  return found == areas().end() ? nullptr : &*found;
}

}  // namespace external_command
