// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "checks.h"
#include "named_ids.h"

namespace external_command {

namespace {

constexpr double kBeyond = 1.0;        // [m] behind the end of the lane, and ...
constexpr double kBeyondShare = 0.02;  // ... this much of its length
constexpr double kApart = 3.0;         // [m] between two lanes
constexpr double kAcross = 15.0;       // [m] between lane and parking space, over the lanes between them
constexpr double kStep = 2.0;          // along a lane [m]
constexpr int kMostSteps = 200;

using Ids = std::vector<std::string>;

class Overlaps {
 public:
  explicit Overlaps(const MapUnderCheck& check) : check_(check), map_(check.map) {
    for (const OverlapData& overlap : check.stated.overlaps) addOverlap(overlap);
    for (const LaneData& lane : check.stated.lanes) addObject(lane.id, "lane", lane.overlaps);
    for (const ParkingSpaceData& space : check.stated.parking_spaces) {
      addObject(space.id, "parking space", space.overlaps);
    }
    for (const AreaData& area : check.stated.areas) addObject(area.id, "area", area.overlaps);
    for (const ParkingSpace& space : map_.parkingSpaces()) polygon_by_id_.emplace(space.id, &space.polygon);
    for (const Area& area : map_.areas()) polygon_by_id_.emplace(area.id, &area.polygon);
    for (const Junction& junction : map_.junctions()) polygon_by_id_.emplace(junction.id, &junction.polygon);
  }

  void run() {
    for (const LaneData& lane : check_.stated.lanes) checkNamed(lane.id, "lane", lane.overlaps);
    for (const ParkingSpaceData& space : check_.stated.parking_spaces) {
      checkNamed(space.id, "parking space", space.overlaps);
    }
    for (const AreaData& area : check_.stated.areas) checkNamed(area.id, "area", area.overlaps);
    for (const OverlapData& overlap : check_.stated.overlaps) checkOverlap(overlap);
  }

 private:
  /// The first of an id counts.
  void addObject(const std::string& id, const char* kind, const Ids& overlaps) {
    if (kind_by_id_.emplace(id, kind).second) overlaps_of_object_.add(id, overlaps);
  }

  void addOverlap(const OverlapData& overlap) {
    if (!overlaps_.insert(overlap.id).second) return;
    for (const OverlapObject& object : overlap.objects) objects_of_overlap_.add(overlap.id, object.id);
  }

  const Lane* laneOf(const OverlapObject& object) const {
    const auto index = object.is_lane ? map_.findLane(object.id) : std::nullopt;
    return index ? &map_.lane(*index) : nullptr;
  }

  std::optional<Point2d> placeOf(const std::string& id) const {
    if (const auto lane = map_.findLane(id)) return map_.lane(*lane).center.points().front();
    const auto polygon = polygon_by_id_.find(id);
    return polygon == polygon_by_id_.end() ? std::nullopt : std::optional<Point2d>(polygon->second->points().front());
  }

  /// An object names an overlap: is it there, and does it name the object?
  void checkNamed(const std::string& id, const char* kind, const Ids& overlaps) {
    for (const std::string& overlap_id : overlaps) {
      if (objects_of_overlap_.has(overlap_id, id)) continue;
      const char* how = overlaps_.count(overlap_id) == 0 ? ", which does not exist" : ", which does not name it";
      check_.faults->add(MapFault::kOverlapOneSided, {id, overlap_id}, {placeOf(id)}, kind, " ", id, " names overlap ",
                         overlap_id, how);
    }
  }

  void checkOverlap(const OverlapData& overlap) {
    for (const OverlapObject& object : overlap.objects) {
      const auto kind = kind_by_id_.find(object.id);
      if (kind != kind_by_id_.end() && !overlaps_of_object_.has(object.id, overlap.id)) {
        check_.faults->add(MapFault::kOverlapOneSided, {object.id, overlap.id}, {placeOf(object.id)}, "overlap ",
                           overlap.id, " names ", kind->second, " ", object.id, ", which does not name it");
      }
      const Lane* lane = laneOf(object);
      if (lane != nullptr) checkRange(overlap, object, *lane);
    }
    for (std::size_t i = 0; i < overlap.objects.size(); ++i) {
      const Lane* lane = laneOf(overlap.objects[i]);
      if (lane == nullptr || !hasRange(overlap.objects[i])) continue;
      for (std::size_t k = 0; k < overlap.objects.size(); ++k) {
        if (k != i) checkPlace(overlap, overlap.objects[i], *lane, overlap.objects[k], k > i);
      }
    }
  }

  static bool hasRange(const OverlapObject& object) {
    return std::isfinite(object.start_s) && std::isfinite(object.end_s) && object.start_s <= object.end_s;
  }

  void checkRange(const OverlapData& overlap, const OverlapObject& object, const Lane& lane) {
    if (!hasRange(object)) return;  // the reader tells
    const double tolerance = kBeyond + kBeyondShare * lane.length();
    const double beyond = std::max(-object.start_s, object.end_s - lane.length());
    if (beyond <= tolerance) return;
    check_.faults->add(MapFault::kOverlapBeyondLane, {overlap.id, lane.id}, {lane.center.points().back(), beyond},
                       overlap.id, ": s ", object.start_s, " to ", object.end_s, " of lane ", lane.id, ", which is ",
                       metres(lane.length()), " long");
  }

  /// Does the stretch of the lane come near the other object?
  void checkPlace(const OverlapData& overlap, const OverlapObject& object, const Lane& lane, const OverlapObject& other,
                  bool is_first_pair) {
    const Lane* other_lane = laneOf(other);
    const auto polygon = polygon_by_id_.find(other.id);
    double distance = 0.0, reach = lane.widthAt(object.start_s) / 2.0;
    if (other_lane != nullptr) {
      if (!is_first_pair || !hasRange(other)) return;
      reach += other_lane->widthAt(other.start_s) / 2.0 + kApart;
      distance = nearest(object, lane, [&](const Point2d& point) { return distanceTo(other, *other_lane, point); });
    } else if (!other.is_lane && polygon != polygon_by_id_.end()) {
      const Polygon& shape = *polygon->second;
      reach += kAcross;
      distance = nearest(object, lane, [&](const Point2d& point) {
        return shape.contains(point) ? 0.0 : shape.distanceToBorder(point);
      });
    }
    if (distance <= reach) return;
    check_.faults->add(MapFault::kOverlapElsewhere, {overlap.id, lane.id, other.id},
                       {lane.center.pointAt(object.start_s), distance}, overlap.id, ": s ", object.start_s, " to ",
                       object.end_s, " of lane ", lane.id, " lies ", metres(distance), " from ", other.id);
  }

  /// Calls `visit(point)` along the stretch.
  template <class Visit>
  static void walk(const OverlapObject& object, const Lane& lane, const Visit& visit) {
    const double from = std::clamp(object.start_s, 0.0, lane.length());
    const double to = std::clamp(object.end_s, 0.0, lane.length());
    const int steps = std::clamp(static_cast<int>(std::ceil((to - from) / kStep)), 1, kMostSteps);
    for (int i = 0; i <= steps; ++i) visit(lane.center.pointAt(from + (to - from) * i / steps));
  }

  template <class DistanceOf>
  static double nearest(const OverlapObject& object, const Lane& lane, const DistanceOf& distanceOf) {
    double distance = std::numeric_limits<double>::infinity();
    walk(object, lane, [&](const Point2d& point) { distance = std::min(distance, distanceOf(point)); });
    return distance;
  }

  /// From a point to a stretch of a lane.
  static double distanceTo(const OverlapObject& object, const Lane& lane, const Point2d& point) {
    const FrenetPoint foot = lane.center.project(point);
    if (foot.s >= object.start_s && foot.s <= object.end_s) return foot.distance;
    return nearest(object, lane, [&](const Point2d& other) { return (other - point).norm(); });
  }

  const MapUnderCheck& check_;
  const HdMap& map_;
  std::unordered_set<std::string_view> overlaps_;
  NamedIds objects_of_overlap_, overlaps_of_object_;
  std::unordered_map<std::string_view, const char*> kind_by_id_;  // of objects
  std::unordered_map<std::string_view, const Polygon*> polygon_by_id_;
};

}  // namespace

void checkOverlaps(const MapUnderCheck& check) { Overlaps(check).run(); }

}  // namespace external_command
