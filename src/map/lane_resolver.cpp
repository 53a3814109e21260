// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "external_command/core/text.h"
#include "lane_checks.h"
#include "lane_heights.h"
#include "map_resolver.h"

namespace external_command {

namespace {

constexpr double kLengthTolerance = 1.0;  // [m], and ...
constexpr double kLengthShare = 0.02;     // ... this much of the length

/// The first point that lies farther than `longest` [m] from the one before it.
const Point2d* findLeap(const std::vector<Point2d>& points, double longest) {
  const auto is_leap = [longest](const Point2d& a, const Point2d& b) { return (b - a).norm() > longest; };
  const auto found = std::adjacent_find(points.begin(), points.end(), is_leap);
  return found == points.end() ? nullptr : &*std::next(found);
}

const Point2d* findImplausible(const std::vector<Point2d>& points) {
  const auto found = std::find_if_not(points.begin(), points.end(), isPlausible);
  return found == points.end() ? nullptr : &*found;
}

/// Where a fault of a lane as a whole is told to lie.
FaultPlace beginOf(const LaneData& lane) {
  const bool has_place = !lane.center.empty() && isPlausible(lane.center.front());
  return {has_place ? std::optional<Point2d>(lane.center.front()) : std::nullopt};
}

/// A map without heights states 0 throughout.
bool hasHeights(const LaneData& lane) {
  return std::any_of(lane.heights.begin(), lane.heights.end(), [](float z) { return z != 0.0F; });
}

bool isUsable(double value) { return std::isfinite(value) && value >= 0.0; }

/// Turns LaneData into Lane: first each lane by itself, then, once every id is known, the references.
class LaneResolver {
 public:
  LaneResolver(MapData* data, const MapParams& params, MapContent* map) : data_(*data), params_(params), map_(*map) {}

  void run() {
    // The look-up table refers to the ids of the lanes, which therefore must not move.
    const auto reversed = std::count_if(data_.lanes.begin(), data_.lanes.end(), [](const LaneData& lane) {
      return lane.direction == LaneDirection::kBidirection;
    });
    map_.lanes.reserve(data_.lanes.size() + static_cast<std::size_t>(reversed));
    has_heights_ = std::any_of(data_.lanes.begin(), data_.lanes.end(), hasHeights);
    for (LaneData& lane : data_.lanes) addLane(&lane);
    for (std::size_t i = 0; i < map_.lanes.size(); ++i) resolveReferences(i);
    deriveLinks();
    for (const RoadData& road : data_.roads) addRoad(road);
  }

 private:
  void addLane(LaneData* lane);
  bool clean(LaneData* lane);
  void cleanBoundary(const LaneData& lane, const char* side, LaneBoundary* boundary);
  void cleanWidths(const LaneData& lane, std::vector<WidthSample>* samples);
  void checkType(const LaneData& lane, const FaultPlace& begin);
  void compareLength(const LaneData& lane, const Polyline& center);
  void resolveReferences(std::size_t index);
  std::vector<LaneIndex> resolved(const std::vector<std::string>& ids, const char* kind, LaneIndex self);
  std::vector<LaneIndex> neighbours(const std::vector<std::string>& ids, const char* kind, LaneIndex self);
  void deriveLinks();
  void addRoad(const RoadData& road);

  MapData& data_;
  const MapParams& params_;
  MapContent& map_;
  bool has_heights_ = false;
  std::vector<const LaneData*> sources_;  // of each lane, for its references
};

void LaneResolver::addLane(LaneData* lane) {
  if (!clean(lane)) return;
  if (map_.lane_by_id.count(lane->id) > 0) {
    map_.faults.add(MapFault::kLaneIdRepeated, {lane->id}, beginOf(*lane), lane->id);
    return;
  }
  const FaultPlace begin = beginOf(*lane);
  try {
    std::vector<HeightSample> heights;
    if (has_heights_) heights = heightProfile(lane->center, lane->heights);
    Polyline center(std::move(lane->center));
    compareLength(*lane, center);
    checkType(*lane, begin);
    map_.lanes.push_back({std::move(lane->id),
                          std::move(center),
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
                          std::move(heights)});
  } catch (const std::invalid_argument& error) {
    map_.faults.add(MapFault::kLaneUnusable, {lane->id}, begin, lane->id, ": the centre line has ", error.what());
    return;
  }
  map_.lane_by_id.emplace(map_.lanes.back().id, static_cast<LaneIndex>(map_.lanes.size() - 1));
  sources_.push_back(lane);
}

/// @return false where the lane cannot be used at all.
bool LaneResolver::clean(LaneData* lane) {
  if (lane->id.empty()) {
    map_.faults.add(MapFault::kLaneUnusable, {}, beginOf(*lane), "a lane without an id");
    return false;
  }
  if (const Point2d* point = findImplausible(lane->center)) {
    map_.faults.add(MapFault::kLaneUnusable, {lane->id}, beginOf(*lane), lane->id, ": point ",
                    point - lane->center.data(), " of the centre line is ", at(*point));
    return false;
  }
  if (const Point2d* point = findLeap(lane->center, params_.max_segment_length)) {
    map_.faults.add(MapFault::kLaneUnusable, {lane->id}, {*std::prev(point)}, lane->id, ": point ",
                    point - lane->center.data(), " of the centre line, ", at(*point), ", lies ",
                    metres((*point - *std::prev(point)).norm()), " from the one before it; the limit is ",
                    metres(params_.max_segment_length), " (~map/max_segment_length)");
    return false;
  }
  cleanBoundary(*lane, "left", &lane->left);
  cleanBoundary(*lane, "right", &lane->right);
  cleanWidths(*lane, &lane->left_widths);
  cleanWidths(*lane, &lane->right_widths);
  if (!isUsable(lane->speed_limit)) {
    map_.faults.add(MapFault::kSpeedLimitUnusable, {lane->id}, beginOf(*lane), lane->id, ": ", lane->speed_limit);
    lane->speed_limit = 0.0;
  }
  return true;
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

void LaneResolver::cleanBoundary(const LaneData& lane, const char* side, LaneBoundary* boundary) {
  if (const Point2d* point = findImplausible(boundary->points)) {
    map_.faults.add(MapFault::kBoundaryUnusable, {lane.id}, beginOf(lane), lane.id, ": point ",
                    point - boundary->points.data(), " of the ", side, " one is ", at(*point));
    boundary->points.clear();
  }
  const auto byS = [](const BoundaryTypeChange& a, const BoundaryTypeChange& b) { return a.s < b.s; };
  std::vector<BoundaryTypeChange>& types = boundary->types;
  types.erase(std::remove_if(types.begin(), types.end(), [](const auto& type) { return !isUsable(type.s); }),
              types.end());
  if (!std::is_sorted(types.begin(), types.end(), byS)) std::stable_sort(types.begin(), types.end(), byS);
}

void LaneResolver::cleanWidths(const LaneData& lane, std::vector<WidthSample>* samples) {
  const auto is_bad = [](const WidthSample& sample) { return !isUsable(sample.s) || !isUsable(sample.width); };
  const auto bad = std::remove_if(samples->begin(), samples->end(), is_bad);
  for (auto sample = bad; sample != samples->end(); ++sample) {
    map_.faults.add(MapFault::kWidthSampleUnusable, {lane.id}, beginOf(lane), lane.id);
  }
  samples->erase(bad, samples->end());
  const auto byS = [](const WidthSample& a, const WidthSample& b) { return a.s < b.s; };
  if (!std::is_sorted(samples->begin(), samples->end(), byS)) std::stable_sort(samples->begin(), samples->end(), byS);
}

void LaneResolver::resolveReferences(std::size_t index) {
  const LaneData& source = *sources_[index];
  const auto self = static_cast<LaneIndex>(index);
  Lane& lane = map_.lanes[index];
  lane.predecessors = resolved(source.predecessors, "predecessor", self);
  lane.successors = resolved(source.successors, "successor", self);
  lane.left_forward = neighbours(source.left_forward, "left forward neighbour", self);
  lane.right_forward = neighbours(source.right_forward, "right forward neighbour", self);
  lane.left_reverse = neighbours(source.left_reverse, "left reverse neighbour", self);
  lane.right_reverse = neighbours(source.right_reverse, "right reverse neighbour", self);
}

/// Without repetitions, in the file's order.
std::vector<LaneIndex> LaneResolver::resolved(const std::vector<std::string>& ids, const char* kind, LaneIndex self) {
  std::vector<LaneIndex> lanes;
  for (const std::string& id : ids) {
    const auto found = map_.lane_by_id.find(id);
    if (found == map_.lane_by_id.end()) {
      const Lane& lane = map_.lanes[self];
      map_.faults.add(MapFault::kReferenceDangling, {lane.id, id}, {lane.center.points().front()}, kind, " ", id,
                      " of ", lane.id);
    } else if (std::find(lanes.begin(), lanes.end(), found->second) == lanes.end()) {
      lanes.push_back(found->second);
    }
  }
  return lanes;
}

/// A lane may lead on into itself (a ring), but it never lies beside itself.
std::vector<LaneIndex> LaneResolver::neighbours(const std::vector<std::string>& ids, const char* kind, LaneIndex self) {
  std::vector<LaneIndex> lanes = resolved(ids, kind, self);
  lanes.erase(std::remove(lanes.begin(), lanes.end(), self), lanes.end());
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
