// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "map_resolver.h"
#include "parking_heading.h"

namespace external_command {

namespace {

// As many lanes of objects as these, for each object and overlap that a file names, no map needs: most overlaps are of
// one lane with one object. Without a limit, n objects that share an overlap with n lanes would have n * n.
constexpr std::size_t kLanesPerName = 10;
constexpr std::size_t kFewLanes = 100000;  // are taken in any case

/// Where a fault of an object is told to lie.
FaultPlace middleOf(const std::vector<Point2d>& points) {
  if (points.empty() || !std::all_of(points.begin(), points.end(), isPlausible)) return {};
  Point2d sum = Point2d::Zero();
  for (const Point2d& point : points) sum += point;
  return {sum / static_cast<double>(points.size())};
}

/// Junctions, parking spaces and areas, and the lanes that overlap them.
class ObjectResolver {
 public:
  ObjectResolver(MapData* data, MapContent* map) : data_(*data), map_(*map) {}

  void run() {
    indexOverlaps();
    for (const JunctionData& junction : data_.junctions) addJunction(junction);
    // The look-up tables refer to the ids of the objects, which therefore must not move.
    map_.parking_spaces.reserve(data_.parking_spaces.size());
    for (const ParkingSpaceData& space : data_.parking_spaces) addParkingSpace(space);
    map_.areas.reserve(data_.areas.size());
    for (const AreaData& area : data_.areas) addArea(area);
  }

 private:
  void indexOverlaps();
  void addJunction(const JunctionData& junction);
  void addParkingSpace(const ParkingSpaceData& space);
  void addArea(const AreaData& area);
  std::optional<Polygon> polygonOf(const std::vector<Point2d>& points, const char* kind, const std::string& id);
  double headingOf(const ParkingSpaceData& space, const Polygon& polygon);
  std::vector<LaneOverlap> lanesOf(const std::string& id, const std::vector<std::string>& overlap_ids);
  void addLanesOf(const OverlapData& overlap, const std::string& object_id, std::vector<LaneOverlap>* lanes);
  void countLane(const OverlapData& overlap, const std::string& object_id);
  LaneOverlap rangeOn(LaneIndex lane, const OverlapObject& object);

  MapData& data_;
  MapContent& map_;
  std::string why_not_;  ///< the last polygon cannot be used
  std::unordered_map<std::string_view, const OverlapData*> overlap_by_id_;
  std::unordered_map<std::string_view, std::vector<const OverlapData*>> overlaps_by_object_;  // lanes left out
  std::size_t names_ = 0;        // of objects in overlaps, and of overlaps in objects
  std::size_t lanes_taken_ = 0;  // from overlaps, for all objects together
};

void ObjectResolver::indexOverlaps() {
  for (OverlapData& overlap : data_.overlaps) {
    // The lanes come first, so that who takes them need not look at the rest.
    std::stable_partition(overlap.objects.begin(), overlap.objects.end(),
                          [](const OverlapObject& object) { return object.is_lane; });
    overlap_by_id_.emplace(overlap.id, &overlap);
    for (const OverlapObject& object : overlap.objects) {
      if (!object.is_lane) overlaps_by_object_[object.id].push_back(&overlap);
    }
    names_ += overlap.objects.size();
  }
  for (const ParkingSpaceData& space : data_.parking_spaces) names_ += space.overlaps.size();
  for (const AreaData& area : data_.areas) names_ += area.overlaps.size();
}

std::optional<Polygon> ObjectResolver::polygonOf(const std::vector<Point2d>& points, const char* kind,
                                                 const std::string& id) {
  try {
    return Polygon(points, text(kind, " ", id));
  } catch (const InvalidRequest& error) {
    map_.faults.add(MapFault::kPolygonUnusable, {id}, middleOf(points), error.what());
    why_not_ = error.what();
    return std::nullopt;
  }
}

/// A lane is inside a junction by an overlap that takes at least half of it.
void ObjectResolver::addJunction(const JunctionData& junction) {
  if (auto polygon = polygonOf(junction.polygon, "junction", junction.id)) {
    map_.junctions.push_back({junction.id, *std::move(polygon)});
  }
  for (const LaneOverlap& overlap : lanesOf(junction.id, {})) {
    Lane& lane = map_.lanes[overlap.lane];
    if (lane.junction_id.empty() && overlap.end_s - overlap.start_s >= lane.length() / 2.0) {
      lane.junction_id = junction.id;
    }
  }
}

void ObjectResolver::addParkingSpace(const ParkingSpaceData& space) {
  if (space.id.empty() || map_.parking_space_by_id.count(space.id) > 0) {
    map_.faults.add(MapFault::kObjectIdRepeated, {space.id}, middleOf(space.polygon), "parking space \"", space.id,
                    "\"");
    return;
  }
  std::vector<Point2d> corners = space.polygon;
  if (putInOrder(&corners)) map_.faults.add(MapFault::kCornersCrossed, {space.id}, middleOf(corners), space.id);
  const auto polygon = polygonOf(corners, "parking space", space.id);
  if (!polygon) {
    map_.unusable_parking_spaces.emplace(space.id, why_not_);
    return;
  }
  std::vector<LaneOverlap> lanes = lanesOf(space.id, space.overlaps);
  if (lanes.empty()) map_.faults.add(MapFault::kSpaceWithoutOverlap, {space.id}, middleOf(corners), space.id);
  map_.parking_spaces.push_back({space.id, *polygon, headingOf(space, *polygon), std::move(lanes)});
  map_.parking_space_by_id.emplace(map_.parking_spaces.back().id, map_.parking_spaces.size() - 1);
}

double ObjectResolver::headingOf(const ParkingSpaceData& space, const Polygon& polygon) {
  if (!space.has_heading || !std::isfinite(space.heading)) {
    map_.faults.add(MapFault::kSpaceHeadingMissing, {space.id}, middleOf(polygon.points()), space.id);
    return derivedParkingHeading(map_, polygon);
  }
  const bool in_degrees = isInDegrees(polygon, space.heading);
  if (in_degrees) {
    map_.faults.add(MapFault::kSpaceHeadingInDegrees, {space.id}, middleOf(polygon.points()), space.id, ": ",
                    space.heading);
  }
  const double heading = normalizeAngle(in_degrees ? space.heading * M_PI / 180.0 : space.heading);
  if (fitsParkingSpace(polygon, heading)) return heading;
  map_.faults.add(MapFault::kSpaceHeadingAcross, {space.id}, middleOf(polygon.points()), space.id, ": ",
                  radians(heading));
  return derivedParkingHeading(map_, polygon);
}

void ObjectResolver::addArea(const AreaData& area) {
  if (area.id.empty() || map_.area_by_id.count(area.id) > 0) {
    map_.faults.add(MapFault::kObjectIdRepeated, {area.id}, middleOf(area.polygon), "area \"", area.id, "\"");
    return;
  }
  auto polygon = polygonOf(area.polygon, "area", area.id);
  if (!polygon) return;
  map_.areas.push_back({area.id, area.name, *std::move(polygon), lanesOf(area.id, area.overlaps)});
  map_.area_by_id.emplace(map_.areas.back().id, map_.areas.size() - 1);
}

/// By the overlaps that the object names; where it names none, by those that name the object.
std::vector<LaneOverlap> ObjectResolver::lanesOf(const std::string& id, const std::vector<std::string>& overlap_ids) {
  std::vector<LaneOverlap> lanes;
  for (const std::string& overlap_id : overlap_ids) {
    const auto found = overlap_by_id_.find(overlap_id);
    if (found == overlap_by_id_.end()) {
      map_.faults.add(MapFault::kOverlapDangling, {id, overlap_id}, {}, "overlap ", overlap_id, " of ", id);
    } else {
      addLanesOf(*found->second, id, &lanes);
    }
  }
  const auto naming = overlaps_by_object_.find(id);
  if (overlap_ids.empty() && naming != overlaps_by_object_.end()) {
    for (const OverlapData* overlap : naming->second) addLanesOf(*overlap, id, &lanes);
  }
  return lanes;
}

void ObjectResolver::addLanesOf(const OverlapData& overlap, const std::string& object_id,
                                std::vector<LaneOverlap>* lanes) {
  for (const OverlapObject& object : overlap.objects) {
    if (!object.is_lane) break;
    countLane(overlap, object_id);
    const auto found = map_.lane_by_id.find(object.id);
    if (found == map_.lane_by_id.end()) {
      map_.faults.add(MapFault::kOverlapDangling, {overlap.id, object.id}, {}, "lane ", object.id, " of overlap ",
                      overlap.id);
    } else {
      const LaneOverlap range = rangeOn(found->second, object);
      lanes->push_back(range);
      const Lane& lane = map_.lanes[range.lane];
      if (lane.reverse) lanes->push_back({*lane.reverse, lane.length() - range.end_s, lane.length() - range.start_s});
    }
  }
}

void ObjectResolver::countLane(const OverlapData& overlap, const std::string& object_id) {
  const std::size_t limit = kFewLanes + kLanesPerName * names_;
  if (++lanes_taken_ <= limit) return;
  throw MapError(text("overlaps give parking spaces, areas and junctions more than ", limit, " lanes, which are ",
                      kLanesPerName, " for each of the ", names_, " names in them and ", kFewLanes,
                      " more; the one too many is of overlap ", overlap.id, " with ", object_id,
                      "; state an overlap of its own for each lane with each object"));
}

LaneOverlap ObjectResolver::rangeOn(LaneIndex lane, const OverlapObject& object) {
  const double length = map_.lanes[lane].length();
  if (!(object.start_s <= object.end_s && std::isfinite(object.start_s) && std::isfinite(object.end_s))) {
    map_.faults.add(MapFault::kOverlapRangeUnusable, {object.id}, {map_.lanes[lane].center.points().front()}, "lane ",
                    object.id, ": s ", object.start_s, " to ", object.end_s);
    return {lane, 0.0, length};
  }
  return {lane, std::clamp(object.start_s, 0.0, length), std::clamp(object.end_s, 0.0, length)};
}

}  // namespace

void resolveObjects(MapData* data, MapContent* map) { ObjectResolver(data, map).run(); }

}  // namespace external_command
