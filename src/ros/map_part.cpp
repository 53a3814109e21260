// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/map_part.h"

#include <algorithm>

namespace external_command {

namespace {

constexpr double kMovedShare = 0.25;  // of the radius, after which another part is drawn

/// 0 inside.
double distanceTo(const BoundingBox& box, const Point2d& place) {
  return (place - place.cwiseMax(box.min).cwiseMin(box.max)).norm();
}

Point2d middleOf(const BoundingBox& box) { return (box.min + box.max) / 2.0; }

template <class Object>
std::vector<const Object*> everyOne(const std::vector<Object>& all) {
  std::vector<const Object*> objects;
  for (const Object& object : all) objects.push_back(&object);
  return objects;
}

/// All, or the nearest to one of `places`.
template <class Object>
std::vector<const Object*> objectsNear(const std::vector<Object>& all, const std::vector<Point2d>& places,
                                       const MapPartParams& params) {
  if (all.size() <= params.max_objects) return everyOne(all);
  std::vector<std::pair<double, const Object*>> found;
  for (const Object& object : all) {
    double distance = params.radius;
    for (const Point2d& place : places) distance = std::min(distance, distanceTo(object.polygon.box(), place));
    if (distance < params.radius) found.emplace_back(distance, &object);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (found.size() > params.max_objects) found.resize(params.max_objects);
  std::vector<const Object*> objects;
  for (const auto& entry : found) objects.push_back(entry.second);
  return objects;
}

/// All, or the nearest, as many of each place.
std::vector<const Lane*> lanesNear(const HdMap& map, const std::vector<Point2d>& places, const MapPartParams& params) {
  if (map.lanes().size() <= params.max_objects) return everyOne(map.lanes());
  LaneQuery query;
  query.max_distance = params.radius;
  query.drivable_only = false;
  std::vector<bool> is_taken(map.lanes().size(), false);
  std::vector<const Lane*> lanes;
  std::size_t places_left = places.size();
  for (const Point2d& place : places) {
    const std::size_t limit = lanes.size() + (params.max_objects - lanes.size()) / places_left--;
    for (const LaneMatch& match : map.lanesWithin(place, query)) {
      if (lanes.size() >= limit) break;
      if (is_taken[match.lane]) continue;
      is_taken[match.lane] = true;
      lanes.push_back(&map.lane(match.lane));
    }
  }
  return lanes;
}

bool isWhole(const HdMap& map, std::size_t max_objects) {
  return std::max({map.lanes().size(), map.junctions().size(), map.parkingSpaces().size(), map.areas().size()}) <=
         max_objects;
}

}  // namespace

MapPartChooser::MapPartChooser(const HdMap& map, const MapPartParams& params)
    : map_(map), params_(params), is_whole_(isWhole(map, params.max_objects)), vehicle_(middleOf(map.box())) {}

void MapPartChooser::placeVehicle(const std::optional<Point2d>& place) {
  if (place) vehicle_ = *place;
}

void MapPartChooser::lookAt(const Point2d& place) { looked_at_ = place; }

std::vector<Point2d> MapPartChooser::places() const {
  std::vector<Point2d> places = {vehicle_};
  if (looked_at_) places.push_back(*looked_at_);
  return places;
}

bool MapPartChooser::hasMoved() const {
  if (is_whole_) return false;
  const std::vector<Point2d> now = places();
  if (drawn_.size() != now.size()) return true;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if ((now[i] - drawn_[i]).norm() > kMovedShare * params_.radius) return true;
  }
  return false;
}

MapPart MapPartChooser::part() {
  const std::vector<Point2d> now = places();
  drawn_ = now;
  MapPart part;
  part.box = map_.box();
  if (map_.lanes().size() > params_.max_objects) {
    const Point2d reach(params_.radius, params_.radius);
    part.box = {now.front() - reach, now.front() + reach};
  }
  part.lanes = lanesNear(map_, now, params_);
  part.junctions = objectsNear(map_.junctions(), now, params_);
  part.spaces = objectsNear(map_.parkingSpaces(), now, params_);
  part.areas = objectsNear(map_.areas(), now, params_);
  return part;
}

}  // namespace external_command
