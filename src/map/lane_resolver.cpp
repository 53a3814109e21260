// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "external_command/core/text.h"
#include "lane_blocks.h"
#include "lane_checks.h"
#include "lane_cleaning.h"
#include "map_resolver.h"

namespace external_command {

namespace {

constexpr double kLengthTolerance = 1.0;  // [m], and ...
constexpr double kLengthShare = 0.02;     // ... this much of the length

/// Turns LaneData into Lane: first each lane by itself, then, once every id is known, the references.
class LaneResolver {
 public:
  LaneResolver(MapData* data, const MapParams& params, MapContent* map) : data_(*data), params_(params), map_(*map) {}

  void run() {
    const bool has_heights = std::any_of(data_.lanes.begin(), data_.lanes.end(), hasHeights);
    std::vector<std::optional<LaneShape>> shapes(data_.lanes.size());
    inBlocks(shapes.size(), &map_.faults, [&](std::size_t begin, std::size_t end, MapFaults* faults) {
      for (std::size_t i = begin; i < end; ++i) shapes[i] = cleanLane(params_, has_heights, &data_.lanes[i], faults);
    });
    makeRoom();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (shapes[i]) addLane(&data_.lanes[i], *std::move(shapes[i]));
    }
    inBlocks(map_.lanes.size(), &map_.faults, [this](std::size_t begin, std::size_t end, MapFaults* faults) {
      for (std::size_t i = begin; i < end; ++i) resolveReferences(i, faults);
    });
    deriveLinks();
    for (const RoadData& road : data_.roads) addRoad(road);
  }

 private:
  void makeRoom();
  void addLane(LaneData* lane, LaneShape shape);
  void checkType(const LaneData& lane, const FaultPlace& begin);
  void compareLength(const LaneData& lane, const Polyline& center);
  void resolveReferences(std::size_t index, MapFaults* faults);
  std::vector<LaneIndex> resolved(const std::vector<std::string>& ids, const char* kind, LaneIndex self,
                                  MapFaults* faults) const;
  void deriveLinks();
  void addRoad(const RoadData& road);

  MapData& data_;
  const MapParams& params_;
  MapContent& map_;
  std::vector<const LaneData*> sources_;  // of each lane, for its references
};

/// The look-up table refers to the ids of the lanes, which therefore must not move.
void LaneResolver::makeRoom() {
  const auto reversed = std::count_if(data_.lanes.begin(), data_.lanes.end(), [](const LaneData& lane) {
    return lane.direction == LaneDirection::kBidirection;
  });
  map_.lanes.reserve(data_.lanes.size() + static_cast<std::size_t>(reversed));
  map_.lane_by_id.reserve(data_.lanes.size());
  sources_.reserve(data_.lanes.size());
}

void LaneResolver::addLane(LaneData* lane, LaneShape shape) {
  const FaultPlace begin{shape.center.points().front()};
  if (map_.lane_by_id.count(lane->id) > 0) {
    map_.faults.add(MapFault::kLaneIdRepeated, {lane->id}, begin, lane->id);
    return;
  }
  compareLength(*lane, shape.center);
  checkType(*lane, begin);
  map_.lanes.push_back({std::move(lane->id),
                        std::move(shape.center),
                        std::move(lane->left),
                        std::move(lane->right),
                        std::move(lane->left_widths),
                        std::move(lane->right_widths),
                        lane->speed_limit,
                        lane->type,
                        lane->turn,
                        lane->direction,
                        {},
                        {},
                        {},
                        {},
                        {},
                        {},
                        "",
                        std::move(lane->junction),
                        std::move(shape.heights)});
  map_.lane_by_id.emplace(map_.lanes.back().id, static_cast<LaneIndex>(map_.lanes.size() - 1));
  sources_.push_back(lane);
}

void LaneResolver::compareLength(const LaneData& lane, const Polyline& center) {
  const double off = std::abs(center.length() - lane.length);
  if (off <= kLengthTolerance + kLengthShare * center.length()) return;
  map_.faults.add(MapFault::kLaneLengthWrong, {lane.id}, {center.points().front()}, lane.id, ": ", metres(lane.length),
                  " stated, ", metres(center.length()), " measured");
}

void LaneResolver::checkType(const LaneData& lane, const FaultPlace& begin) {
  if (lane.type_statement == TypeStatement::kKnown) return;
  const bool is_missing = lane.type_statement == TypeStatement::kMissing;
  map_.faults.add(is_missing ? MapFault::kLaneTypeMissing : MapFault::kLaneTypeUnknown, {lane.id}, begin, lane.id);
}

void LaneResolver::resolveReferences(std::size_t index, MapFaults* faults) {
  const LaneData& source = *sources_[index];
  const auto self = static_cast<LaneIndex>(index);
  const auto links = [&](const std::vector<std::string>& ids, const char* kind) {
    return resolved(ids, kind, self, faults);
  };
  // A lane may lead on into itself (a ring), but it never lies beside itself.
  const auto neighbours = [&](const std::vector<std::string>& ids, const char* kind) {
    std::vector<LaneIndex> lanes = links(ids, kind);
    lanes.erase(std::remove(lanes.begin(), lanes.end(), self), lanes.end());
    return lanes;
  };
  Lane& lane = map_.lanes[index];
  lane.predecessors = links(source.predecessors, "predecessor");
  lane.successors = links(source.successors, "successor");
  lane.left_forward = neighbours(source.left_forward, "left forward neighbour");
  lane.right_forward = neighbours(source.right_forward, "right forward neighbour");
  lane.left_reverse = neighbours(source.left_reverse, "left reverse neighbour");
  lane.right_reverse = neighbours(source.right_reverse, "right reverse neighbour");
}

/// Without repetitions, in the file's order.
std::vector<LaneIndex> LaneResolver::resolved(const std::vector<std::string>& ids, const char* kind, LaneIndex self,
                                              MapFaults* faults) const {
  std::vector<LaneIndex> lanes;
  for (const std::string& id : ids) {
    const auto found = map_.lane_by_id.find(id);
    if (found == map_.lane_by_id.end()) {
      const Lane& lane = map_.lanes[self];
      faults->add(MapFault::kReferenceDangling, {lane.id, id}, {lane.center.points().front()}, kind, " ", id, " of ",
                  lane.id);
    } else if (std::find(lanes.begin(), lanes.end(), found->second) == lanes.end()) {
      lanes.push_back(found->second);
    }
  }
  return lanes;
}

/// Files that link their lanes in one direction only get the other one from it. Where a file states both they are left
/// as they are, even where they disagree: the successors are what a route may use.
void LaneResolver::deriveLinks() {
  const auto no_lane_has = [this](std::vector<LaneIndex> Lane::*links) {
    return std::all_of(map_.lanes.begin(), map_.lanes.end(), [&](const Lane& lane) { return (lane.*links).empty(); });
  };
  const auto invert = [this](std::vector<LaneIndex> Lane::*from, std::vector<LaneIndex> Lane::*to) {
    for (std::size_t i = 0; i < map_.lanes.size(); ++i) {
      for (const LaneIndex other : map_.lanes[i].*from) {
        (map_.lanes[other].*to).push_back(static_cast<LaneIndex>(i));
      }
    }
  };
  const bool has_no_successors = no_lane_has(&Lane::successors);
  const bool has_no_predecessors = no_lane_has(&Lane::predecessors);
  if (has_no_successors && !has_no_predecessors) {
    for (const Lane& lane : map_.lanes) {
      if (lane.predecessors.empty()) continue;
      map_.faults.add(MapFault::kLinkBackwardsOnly, {lane.id}, {lane.center.points().front()}, lane.id);
    }
    invert(&Lane::predecessors, &Lane::successors);
  } else if (has_no_predecessors) {
    invert(&Lane::successors, &Lane::predecessors);
  }
}

void LaneResolver::addRoad(const RoadData& road) {
  std::vector<LaneIndex>& lanes = map_.lanes_of_road[road.id];
  for (const RoadSectionData& section : road.sections) {
    for (const std::string& id : section.lanes) {
      const auto found = map_.lane_by_id.find(id);
      if (found == map_.lane_by_id.end()) {
        map_.faults.add(MapFault::kReferenceDangling, {road.id, id}, {}, "lane ", id, " of road ", road.id);
        continue;
      }
      Lane& lane = map_.lanes[found->second];
      if (!lane.road_id.empty() && lane.road_id != road.id) {
        map_.faults.add(MapFault::kLaneOfTwoRoads, {lane.id, lane.road_id, road.id}, {lane.center.points().front()},
                        lane.id, ": ", lane.road_id, " and ", road.id);
        continue;
      }
      if (lane.road_id.empty()) lanes.push_back(found->second);
      lane.road_id = road.id;
      if (lane.junction_id.empty()) lane.junction_id = road.junction;
    }
  }
}

}  // namespace

void resolveLanes(MapData* data, const MapParams& params, MapContent* map) {
  stretchPointLanes(data, &map->faults);
  LaneResolver(data, params, map).run();
  mendNeighbours(map);
  addReverseLanes(params.max_link_gap, map);
  checkLinks(params.max_link_gap, map);
}

}  // namespace external_command
