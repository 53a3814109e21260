// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/lane_way_tool.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/text.h"
#include "lane_pair.h"

namespace external_command {

namespace {

constexpr double kBesideLane = 0.1;  // [m] by which `s` may miss its lane: map files round their lengths

void requireWithin(const char* key, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN
  throw InvalidParameter(text(key, " is ", value, "; it must lie in [", low, ", ", high, "]"));
}

LanePoint pointOf(const LaneMatch& match) { return {match.lane, match.frenet.s}; }

std::vector<LaneMatch> routable(const HdMap& map, std::vector<LaneMatch> matches) {
  matches.erase(std::remove_if(matches.begin(), matches.end(),
                               [&](const LaneMatch& match) { return !isRoutable(map.lane(match.lane)); }),
                matches.end());
  return matches;
}

/// The nearest lane that routes use.
std::optional<LaneMatch> nearestRoutable(const HdMap& map, const Point2d& point, const LaneQuery& query) {
  const auto nearest = map.nearestLane(point, query);
  if (!nearest || isRoutable(map.lane(nearest->lane))) return nearest;
  const std::vector<LaneMatch> matches = routable(map, map.lanesWithin(point, query));
  return matches.empty() ? std::nullopt : std::optional<LaneMatch>(matches.front());
}

}  // namespace

void LaneWayParams::validate() const {
  requireWithin("snap_distance", snap_distance, 0.01, 1000.0);
  requireWithin("snap_heading", snap_heading, 0.01, M_PI);
  requireWithin("off_lane_distance", off_lane_distance, 0.0, 1000.0);
  requireWithin("off_lane_heading", off_lane_heading, 0.0, M_PI);
  requireWithin("park_and_go_radius", park_and_go_radius, 0.01, 1000.0);
  requireWithin("parking_lane_radius", parking_lane_radius, 0.01, 1000.0);
}

LaneWayTool::LaneWayTool(const HdMap& map, const LaneWayParams& params) : map_(map), params_(params) {}

LanePoint LaneWayTool::fromPose(const Point2d& point, const std::optional<double>& heading,
                                const std::string& name) const {
  if (!point.allFinite() || (heading && !std::isfinite(*heading))) throw InvalidRequest(text(name, " is not finite"));
  LaneQuery query;
  if (heading) {
    query.max_distance = params_.snap_distance;
    query.heading = heading;
    query.max_heading_difference = params_.snap_heading;
  }
  const auto match = nearestRoutable(map_, point, query);
  if (match) return pointOf(*match);

  const std::string place = heading ? at(Pose2d{point.x(), point.y(), *heading}) : at(point);
  const auto nearest = nearestRoutable(map_, point, {});
  if (!nearest) throw OffMap(text(name, " ", place, ": the map has no lane to drive on"));
  std::string difference;
  if (heading) {
    difference = text(", whose heading differs by ", std::abs(angleBetween(*heading, nearest->heading)), " rad");
  }
  throw OffMap(text(name, " ", place, " is ", metres(nearest->frenet.distance), " from the nearest lane ",
                    map_.lane(nearest->lane).id, difference, "; the limits are ", metres(params_.snap_distance),
                    " (~snap_distance) and ", params_.snap_heading, " rad (~snap_heading)"));
}

LanePoint LaneWayTool::fromLane(const std::string& id, double s, const std::string& name) const {
  const auto index = map_.findLane(id);
  if (!index) throw InvalidRequest(text(name, " names lane '", id, "', which the map does not have"));
  const Lane& lane = map_.lane(*index);
  if (!isRoutable(lane)) throw InvalidRequest(text(name, " names lane ", id, ", which is not for driving"));
  if (!(s >= -kBesideLane && s <= lane.length() + kBesideLane)) {  // catches NaN
    throw InvalidRequest(text(name, " has s ", s, " m; lane ", id, " goes from 0 to ", metres(lane.length())));
  }
  return {*index, std::clamp(s, 0.0, lane.length())};
}

bool LaneWayTool::isOffLane(const Pose2d& vehicle) const {
  LaneQuery query;
  query.max_distance = params_.off_lane_distance;
  query.heading = vehicle.heading;
  query.max_heading_difference = params_.off_lane_heading;
  return !nearestRoutable(map_, vehicle.position(), query);
}

std::vector<LanePoint> LaneWayTool::fromVehicle(const Pose2d& vehicle) const {
  if (!vehicle.isFinite()) throw InvalidRequest("the vehicle's pose is not finite");
  LaneQuery query;
  query.max_distance = params_.off_lane_distance;
  query.heading = vehicle.heading;
  query.max_heading_difference = params_.off_lane_heading;
  if (const auto own = nearestRoutable(map_, vehicle.position(), query)) return {pointOf(*own)};
  std::vector<LanePoint> candidates = within(vehicle.position(), params_.park_and_go_radius);
  if (!candidates.empty()) return candidates;
  const auto nearest = nearestRoutable(map_, vehicle.position(), {});
  throw OffMap(text("the vehicle at ", at(vehicle), " is off the lanes and ",
                    nearest ? text(metres(nearest->frenet.distance), " from the nearest, ", map_.lane(nearest->lane).id)
                            : "the map has none to drive on",
                    "; the limit is ", metres(params_.park_and_go_radius), " (~park_and_go_radius)"));
}

std::vector<LanePoint> LaneWayTool::fromParkingSpace(const std::string& id, bool* used_geometry) const {
  const ParkingSpace* space = map_.findParkingSpace(id);
  if (space == nullptr) {
    throw InvalidRequest(
        text("parking_spot_id '", id, "' is none of the map's ", map_.parkingSpaces().size(), " parking spaces"));
  }
  Point2d middle = Point2d::Zero();
  for (const Point2d& corner : space->polygon.points()) middle += corner / space->polygon.points().size();
  std::vector<LanePoint> candidates;
  for (const LaneOverlap& overlap : space->lanes) {
    const Lane& lane = map_.lane(overlap.lane);
    if (isRoutable(lane)) candidates.push_back({overlap.lane, lane.center.project(middle).s});
  }
  if (used_geometry != nullptr) *used_geometry = candidates.empty();
  if (candidates.empty()) candidates = within(middle, params_.parking_lane_radius);
  if (!candidates.empty()) return candidates;
  throw OffMap(text("no lane to drive on lies within ", metres(params_.parking_lane_radius),
                    " (~parking_lane_radius) of parking space ", id, " at ", at(middle)));
}

std::vector<LanePoint> LaneWayTool::within(const Point2d& point, double radius) const {
  LaneQuery query;
  query.max_distance = radius;
  std::vector<LanePoint> points;
  for (const LaneMatch& match : routable(map_, map_.lanesWithin(point, query))) points.push_back(pointOf(match));
  return points;
}

}  // namespace external_command
