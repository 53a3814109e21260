// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/object_search.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/map/near_ids.h"

namespace external_command {

namespace {

constexpr double kFirstRadius = 50.0;  // that is looked at where there is no limit [m]
constexpr double kRadiusFactor = 4.0;  // by which it grows until enough is found
constexpr double kWholeWorld = 1e9;    // [m]

/// An object that matches, with as little as it takes to put it in order.
struct Candidate {
  double distance = 0.0;  ///< [m]
  MapObjectKind kind = MapObjectKind::kLane;
  const std::string* id = nullptr;
  std::size_t index = 0;         ///< in the map's list of that kind; of a road that of the lane that stands for it
  std::optional<double> s = {};  ///< of the nearest point of that lane [m]

  auto order() const { return std::tie(distance, *id, kind); }
};

class Search {
 public:
  Search(const HdMap& map, const ObjectQuery& query) : map_(map), query_(query) {}

  bool wants(MapObjectKind kind) const { return !query_.kind || *query_.kind == kind; }

  /// All that match, wherever they are.
  std::vector<Candidate> all() const {
    std::vector<Candidate> found;
    addLanesAndRoads(&found);
    addPolygons(MapObjectKind::kParkingSpace, map_.parkingSpaces(), std::nullopt, &found);
    addPolygons(MapObjectKind::kArea, map_.areas(), std::nullopt, &found);
    return found;
  }

  /// All that match within `radius` [m] of the query's point.
  std::vector<Candidate> within(double radius) const {
    std::vector<Candidate> found;
    addNearLanesAndRoads(radius, &found);
    addPolygons(MapObjectKind::kParkingSpace, map_.parkingSpaces(), radius, &found);
    addPolygons(MapObjectKind::kArea, map_.areas(), radius, &found);
    return found;
  }

 private:
  bool isWanted(const std::string& id) const { return query_.id.empty() || query_.id == id; }

  void addLanesAndRoads(std::vector<Candidate>* found) const {
    std::unordered_map<std::string, std::size_t> roads;
    for (std::size_t i = 0; i < map_.lanes().size(); ++i) {
      const Lane& lane = map_.lanes()[i];
      if (lane.is_reversed) continue;
      if (wants(MapObjectKind::kLane) && isWanted(lane.id)) found->push_back({0.0, MapObjectKind::kLane, &lane.id, i});
      if (!wants(MapObjectKind::kRoad) || lane.road_id.empty() || !isWanted(lane.road_id)) continue;
      if (roads.emplace(lane.road_id, i).second) found->push_back({0.0, MapObjectKind::kRoad, &lane.road_id, i});
    }
  }

  void addNearLanesAndRoads(double radius, std::vector<Candidate>* found) const {
    if (!wants(MapObjectKind::kLane) && !wants(MapObjectKind::kRoad)) return;
    LaneQuery query;
    query.max_distance = radius;
    query.drivable_only = false;
    std::set<std::pair<MapObjectKind, std::string>> seen;  // the nearest place of each comes first
    for (const LaneMatch& match : map_.lanesWithin(*query_.near, query)) {
      const Lane& lane = map_.lane(match.lane);
      if (lane.is_reversed) continue;
      for (const auto& [kind, id] :
           {std::pair(MapObjectKind::kLane, &lane.id), std::pair(MapObjectKind::kRoad, &lane.road_id)}) {
        if (!wants(kind) || id->empty() || !isWanted(*id) || !seen.emplace(kind, *id).second) continue;
        found->push_back({match.frenet.distance, kind, id, match.lane, match.frenet.s});
      }
    }
  }

  template <class Objects>
  void addPolygons(MapObjectKind kind, const Objects& objects, std::optional<double> radius,
                   std::vector<Candidate>* found) const {
    if (!wants(kind)) return;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!isWanted(objects[i].id) || (radius && boxDistanceTo(objects[i].polygon.box()) > *radius)) continue;
      const double distance = radius ? distanceTo(objects[i].polygon) : 0.0;
      if (!radius || distance <= *radius) found->push_back({distance, kind, &objects[i].id, i});
    }
  }

  double boxDistanceTo(const BoundingBox& box) const {
    return (box.min - *query_.near).cwiseMax(*query_.near - box.max).cwiseMax(0.0).norm();
  }

  double distanceTo(const Polygon& polygon) const {
    return polygon.contains(*query_.near) ? 0.0 : polygon.distanceToBorder(*query_.near);
  }

  const HdMap& map_;
  const ObjectQuery& query_;
};

/// Of a simple polygon.
Point2d centroid(const Polygon& polygon) {
  const std::vector<Point2d>& points = polygon.points();
  const Point2d origin = points.front();
  Point2d sum = Point2d::Zero();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point2d a = points[i] - origin, b = points[i + 1] - origin;
    sum += (a.x() * b.y() - a.y() * b.x()) * (a + b);
  }
  return origin + sum / (6.0 * polygon.area());
}

/// Of the polygon, along and across `heading` [m].
Point2d extentOf(const Polygon& polygon, double heading) {
  const Point2d along = unitVector(heading), left = unitVector(heading + M_PI / 2.0);
  Point2d low(1e18, 1e18), high(-1e18, -1e18);
  for (const Point2d& point : polygon.points()) {
    const Point2d place(along.dot(point), left.dot(point));
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return high - low;
}

FoundObject describeLane(const HdMap& map, const Candidate& candidate) {
  const auto index = static_cast<LaneIndex>(candidate.index);
  const Lane& lane = map.lane(index);
  const double s = candidate.s.value_or(lane.length() / 2.0);
  FoundObject object;
  object.pose = lane.center.poseAt(s);
  object.has_heading = true;
  object.height = lane.heightAt(s);
  object.length = lane.length();
  object.width = lane.widthAt(s);
  object.lane = index;
  return object;
}

FoundObject describeRoad(const HdMap& map, const Candidate& candidate) {
  const std::vector<LaneIndex> lanes = map.lanesOfRoad(*candidate.id);
  Candidate place = candidate;
  if (!candidate.s) place.index = lanes[lanes.size() / 2];
  FoundObject object = describeLane(map, place);
  object.length = object.width = 0.0;
  for (const LaneIndex lane : lanes) {
    if (!map.lane(lane).is_reversed) object.lane_ids.push_back(map.lane(lane).id);
  }
  return object;
}

FoundObject describeSpace(const HdMap& map, const ParkingSpace& space) {
  FoundObject object;
  const Point2d middle = centroid(space.polygon);
  const Point2d extent = extentOf(space.polygon, space.heading);
  object.pose = {middle.x(), middle.y(), space.heading};
  object.has_heading = true;
  object.length = extent.maxCoeff();
  object.width = extent.minCoeff();
  std::unordered_set<std::string_view> seen;
  for (const LaneOverlap& overlap : space.lanes) {
    const std::string& id = map.lane(overlap.lane).id;
    if (seen.insert(id).second) object.lane_ids.push_back(id);
  }
  object.polygon = &space.polygon;
  return object;
}

FoundObject describeArea(const Area& area) {
  FoundObject object;
  const Point2d middle = centroid(area.polygon);
  object.pose = {middle.x(), middle.y(), 0.0};
  object.polygon = &area.polygon;
  return object;
}

FoundObject describe(const HdMap& map, const Candidate& candidate) {
  switch (candidate.kind) {
    case MapObjectKind::kLane:
      return describeLane(map, candidate);
    case MapObjectKind::kRoad:
      return describeRoad(map, candidate);
    case MapObjectKind::kParkingSpace:
      return describeSpace(map, map.parkingSpaces()[candidate.index]);
    case MapObjectKind::kArea:
      break;
  }
  return describeArea(map.areas()[candidate.index]);
}

void requireValid(const ObjectQuery& query) {
  if (query.near && !isPlausible(*query.near)) {
    throw InvalidRequest(
        text("point is (", query.near->x(), ", ", query.near->y(), "); it must be a point of the map"));
  }
  if (query.radius && !(*query.radius >= 0.0)) {
    throw InvalidRequest(text("radius is ", *query.radius, "; it must not be negative, 0 for no limit"));
  }
}

[[noreturn]] void refuseId(const HdMap& map, const ObjectQuery& query) {
  const auto kind = query.kind;
  std::string near;
  if (!kind || *kind == MapObjectKind::kLane) near += nearLaneIds(map, query.id);
  if (!kind || *kind == MapObjectKind::kRoad) near += nearRoadIds(map, query.id);
  if (!kind || *kind == MapObjectKind::kParkingSpace) {
    const std::string why_not = map.whyUnusable(query.id);
    near += why_not.empty() ? nearParkingSpaceIds(map, query.id) : "; its polygon is wrong: " + why_not;
  }
  if (!kind || *kind == MapObjectKind::kArea) near += nearAreaIds(map, query.id);
  throw UnknownId(
      text("the map has no ", kind ? nameOf(*kind) : "lane, road, parking space or area", " ", quoted(query.id), near));
}

FoundObjects foundOf(const HdMap& map, std::vector<Candidate> candidates, std::size_t max_count) {
  FoundObjects found;
  found.total = candidates.size();
  const std::size_t count = std::min(max_count, candidates.size());
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end(),
                    [](const Candidate& a, const Candidate& b) { return a.order() < b.order(); });
  for (std::size_t i = 0; i < count; ++i) {
    FoundObject object = describe(map, candidates[i]);
    object.kind = candidates[i].kind;
    object.id = *candidates[i].id;
    object.distance = candidates[i].distance;
    found.objects.push_back(std::move(object));
  }
  return found;
}

}  // namespace

const char* nameOf(MapObjectKind kind) {
  switch (kind) {
    case MapObjectKind::kLane:
      return "lane";
    case MapObjectKind::kRoad:
      return "road";
    case MapObjectKind::kParkingSpace:
      return "parking space";
    case MapObjectKind::kArea:
      break;
  }
  return "area";
}

FoundObjects findObjects(const HdMap& map, const ObjectQuery& query) {
  requireValid(query);
  const Search search(map, query);
  if (query.near && query.radius) {
    FoundObjects found = foundOf(map, search.within(*query.radius), query.max_count);
    if (found.total == 0 && !query.id.empty() && search.all().empty()) refuseId(map, query);
    return found;
  }
  std::vector<Candidate> all = search.all();
  if (all.empty() && !query.id.empty()) refuseId(map, query);
  if (!query.near) return foundOf(map, std::move(all), query.max_count);
  const std::size_t wanted = std::min(query.max_count, all.size());
  for (double radius = kFirstRadius;; radius *= kRadiusFactor) {
    std::vector<Candidate> near = search.within(radius);
    if (near.size() < wanted && radius < kWholeWorld) continue;
    FoundObjects found = foundOf(map, std::move(near), query.max_count);
    found.total = all.size();
    return found;
  }
}

}  // namespace external_command
