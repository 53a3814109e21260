// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "external_command/core/text.h"
#include "lane_checks.h"
#include "lane_heights.h"
#include "map_resolver.h"
#include "warning_counter.h"

namespace external_command {

namespace {

constexpr double kLengthTolerance = 1.0;  // [m], and ...
constexpr double kLengthShare = 0.02;     // ... this much of the length

constexpr double kLongestSegment = 10000.0;  ///< of a centre line, between two points [m]

/// The first point that lies too far from the one before it.
const Point2d* findLeap(const std::vector<Point2d>& points) {
  const auto is_leap = [](const Point2d& a, const Point2d& b) { return (b - a).norm() > kLongestSegment; };
  const auto found = std::adjacent_find(points.begin(), points.end(), is_leap);
  return found == points.end() ? nullptr : &*std::next(found);
}

const Point2d* findImplausible(const std::vector<Point2d>& points) {
  const auto found = std::find_if_not(points.begin(), points.end(), isPlausible);
  return found == points.end() ? nullptr : &*found;
}

/// A map without heights states 0 throughout.
bool hasHeights(const LaneData& lane) {
  return std::any_of(lane.heights.begin(), lane.heights.end(), [](float z) { return z != 0.0F; });
}

bool isUsable(double value) { return std::isfinite(value) && value >= 0.0; }

/// Turns LaneData into Lane: first each lane by itself, then, once every id is known, the references.
class LaneResolver {
 public:
  LaneResolver(MapData* data, MapContent* map) : data_(*data), map_(*map) {}

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
    for (const WarningCounter* counter :
         {&repeated_, &dangling_, &lengths_, &boundaries_, &samples_, &speeds_, &unlinked_, &roads_, &unusable_}) {
      counter->report(&map_.warnings);
    }
  }

 private:
  void addLane(LaneData* lane);
  bool clean(LaneData* lane);
  void cleanBoundary(const std::string& lane_id, const char* side, LaneBoundary* boundary);
  void cleanWidths(const std::string& lane_id, std::vector<WidthSample>* samples);
  void resolveReferences(std::size_t index);
  std::vector<LaneIndex> resolved(const std::vector<std::string>& ids, const char* kind, LaneIndex self);
  std::vector<LaneIndex> neighbours(const std::vector<std::string>& ids, const char* kind, LaneIndex self);
  void deriveLinks();
  void addRoad(const RoadData& road);

  MapData& data_;
  MapContent& map_;
  bool has_heights_ = false;
  std::vector<const LaneData*> sources_;  // of each lane, for its references
  WarningCounter unusable_{"lanes dropped that cannot be used"};
  WarningCounter repeated_{"lanes dropped whose id an earlier lane has"};
  WarningCounter dangling_{"references to lanes that do not exist"};
  WarningCounter lengths_{"lanes whose length is missing or wrong; that of the centre line is used"};
  WarningCounter boundaries_{"lane boundaries dropped that have a coordinate out of range"};
  WarningCounter samples_{"width samples dropped that are negative or not finite"};
  WarningCounter speeds_{"speed limits dropped that are negative or not finite"};
  WarningCounter unlinked_{"lanes linked backwards only; what leads on was taken from the predecessors"};
  WarningCounter roads_{"lanes named by more than one road, of which the first counts"};
};

void LaneResolver::addLane(LaneData* lane) {
  if (!clean(lane)) return;
  if (map_.lane_by_id.count(lane->id) > 0) return repeated_.add(lane->id);
  try {
    std::vector<HeightSample> heights;
    if (has_heights_) heights = heightProfile(lane->center, lane->heights);
    Polyline center(lane->center);
    if (std::abs(center.length() - lane->length) > kLengthTolerance + kLengthShare * center.length()) {
      lengths_.add(lane->id, ": ", metres(lane->length), " stated, ", metres(center.length()), " measured");
    }
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
    return unusable_.add(lane->id, ": the centre line has ", error.what());
  }
  map_.lane_by_id.emplace(map_.lanes.back().id, static_cast<LaneIndex>(map_.lanes.size() - 1));
  sources_.push_back(lane);
}

/// @return false where the lane cannot be used at all.
bool LaneResolver::clean(LaneData* lane) {
  if (lane->id.empty()) {
    unusable_.add("a lane without an id");
    return false;
  }
  if (const Point2d* point = findImplausible(lane->center)) {
    unusable_.add(lane->id, ": point ", point - lane->center.data(), " of the centre line is ", at(*point));
    return false;
  }
  if (const Point2d* point = findLeap(lane->center)) {
    unusable_.add(lane->id, ": point ", point - lane->center.data(), " of the centre line, ", at(*point), ", lies ",
                  metres((*point - *std::prev(point)).norm()), " from the one before it; the limit is ",
                  metres(kLongestSegment));
    return false;
  }
  cleanBoundary(lane->id, "left", &lane->left);
  cleanBoundary(lane->id, "right", &lane->right);
  cleanWidths(lane->id, &lane->left_widths);
  cleanWidths(lane->id, &lane->right_widths);
  if (!isUsable(lane->speed_limit)) {
    speeds_.add(lane->id, ": ", lane->speed_limit);
    lane->speed_limit = 0.0;
  }
  return true;
}

void LaneResolver::cleanBoundary(const std::string& lane_id, const char* side, LaneBoundary* boundary) {
  if (const Point2d* point = findImplausible(boundary->points)) {
    boundaries_.add(lane_id, ": point ", point - boundary->points.data(), " of the ", side, " one is ", at(*point));
    boundary->points.clear();
  }
  const auto byS = [](const BoundaryTypeChange& a, const BoundaryTypeChange& b) { return a.s < b.s; };
  std::vector<BoundaryTypeChange>& types = boundary->types;
  types.erase(std::remove_if(types.begin(), types.end(), [](const auto& type) { return !isUsable(type.s); }),
              types.end());
  if (!std::is_sorted(types.begin(), types.end(), byS)) std::stable_sort(types.begin(), types.end(), byS);
}

void LaneResolver::cleanWidths(const std::string& lane_id, std::vector<WidthSample>* samples) {
  const auto is_bad = [](const WidthSample& sample) { return !isUsable(sample.s) || !isUsable(sample.width); };
  const auto bad = std::remove_if(samples->begin(), samples->end(), is_bad);
  for (auto sample = bad; sample != samples->end(); ++sample) samples_.add(lane_id);
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
      dangling_.add(kind, " ", id, " of ", map_.lanes[self].id);
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
      if (!lane.predecessors.empty()) unlinked_.add(lane.id);
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
        dangling_.add("lane ", id, " of road ", road.id);
        continue;
      }
      Lane& lane = map_.lanes[found->second];
      if (!lane.road_id.empty() && lane.road_id != road.id) {
        roads_.add(lane.id, ": ", lane.road_id, " and ", road.id);
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
  stretchPointLanes(data, &map->warnings);
  LaneResolver(data, map).run();
  mendNeighbours(map);
  addReverseLanes(params.max_link_gap, map);
  checkLinks(params.max_link_gap, map);
}

}  // namespace external_command
