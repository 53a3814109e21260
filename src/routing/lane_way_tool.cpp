// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/lane_way_tool.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "external_command/core/parameter_range.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/map/near_ids.h"
#include "external_command/routing/area_access.h"

namespace external_command {

namespace {

constexpr double kEnd = 0.001;       // [m]
constexpr double kBesideLane = 0.1;  // [m] by which `s` may miss its lane: map files round their lengths

/// Leaves out lanes at whose end the point lies where it lies on a lane that follows, too.
void dropEnds(const HdMap& map, std::vector<LaneMatch>* matches) {
  const auto isOther = [&](const LaneMatch& match) {
    const Lane& lane = map.lane(match.lane);
    return match.frenet.s > lane.length() - kEnd &&
           std::any_of(matches->begin(), matches->end(), [&](const LaneMatch& other) {
             return std::count(lane.successors.begin(), lane.successors.end(), other.lane) > 0;
           });
  };
  std::vector<LaneMatch> kept;
  std::copy_if(matches->begin(), matches->end(), std::back_inserter(kept),
               [&](const LaneMatch& match) { return !isOther(match); });
  if (!kept.empty()) *matches = std::move(kept);  // a ring of lanes may be all ends
}

/// By how much the lane's height there differs; 0 where the map gives none [m].
double heightDifference(const HdMap& map, const LaneMatch& match, double height) {
  const auto lane_height = map.lane(match.lane).heightAt(match.frenet.s);
  return lane_height ? std::abs(*lane_height - height) : 0.0;
}

/// Leaves those whose height differs by at most `most` [m].
void keepDeck(const HdMap& map, double height, double most, std::vector<LaneMatch>* matches) {
  const auto is_other = [&](const LaneMatch& match) { return heightDifference(map, match, height) > most; };
  matches->erase(std::remove_if(matches->begin(), matches->end(), is_other), matches->end());
}

/// Leaves those of the lane, in whichever direction.
void keepLane(const HdMap& map, const std::string& id, std::vector<LaneMatch>* matches) {
  const auto is_other = [&](const LaneMatch& match) { return map.lane(match.lane).id != id; };
  matches->erase(std::remove_if(matches->begin(), matches->end(), is_other), matches->end());
}

}  // namespace

void LaneWayParams::validate() const {
  requireParameter("snap_distance", snap_distance, 0.01, 1000.0);
  requireParameter("snap_heading", snap_heading, 0.01, M_PI);
  requireParameter("max_goal_distance", max_goal_distance, 0.01, 1e6);
  requireParameter("lane_keeping_error", lane_keeping_error, 0.0, 100.0);
  requireParameter("heading_error", heading_error, 0.0, M_PI);
  requireParameter("height_error", height_error, 0.0, 1000.0);
  requireParameter("off_lane_price", off_lane_price, 0.0, 1e6);
  requireParameter("off_heading_price", off_heading_price, 0.0, 1e6);
  requireParameter("off_lane_distance", off_lane_distance, 0.0, 1000.0);
  requireParameter("off_lane_heading", off_lane_heading, 0.0, M_PI);
  requireParameter("park_and_go_radius", park_and_go_radius, 0.01, 1000.0);
  requireParameter("area_access_distance", area_access_distance, 0.0, 1000.0);
  requireParameter("parking_lane_radius", parking_lane_radius, 0.01, 1000.0);
}

LaneWayTool::LaneWayTool(const HdMap& map, const LaneWayParams& params) : map_(map), params_(params) {}

std::vector<LaneMatch> LaneWayTool::onDeck(const Point2d& point, const LaneQuery& query, double height) const {
  LaneQuery wide;
  wide.max_distance = std::max(query.max_distance, params_.park_and_go_radius);
  const std::vector<LaneMatch> around = map_.lanesWithin(point, wide);
  double most = params_.height_error;
  const auto fits = [&](const LaneMatch& match) { return heightDifference(map_, match, height) <= most; };
  std::vector<LaneMatch> matches = map_.lanesWithin(point, query);
  if (std::none_of(around.begin(), around.end(), fits)) {
    double least = std::numeric_limits<double>::infinity();
    for (const LaneMatch& match : matches) least = std::min(least, heightDifference(map_, match, height));
    most += least;
  }
  keepDeck(map_, height, most, &matches);
  return matches;
}

/// What the hint rules out does not count, however near it is in the plane.
std::vector<LanePoint> LaneWayTool::candidates(const Point2d& point, LaneQuery query, const LaneHint& hint) const {
  if (!hint.height && hint.lane_id.empty()) {
    const auto nearest = map_.nearestLane(point, query);
    if (!nearest) return {};
    query.max_distance = std::min(query.max_distance, nearest->frenet.distance + params_.lane_keeping_error);
  }
  std::vector<LaneMatch> matches = hint.height ? onDeck(point, query, *hint.height) : map_.lanesWithin(point, query);
  if (!hint.lane_id.empty()) keepLane(map_, hint.lane_id, &matches);
  dropEnds(map_, &matches);
  const auto turn = [&](const LaneMatch& match) {
    return query.heading ? std::abs(angleBetween(*query.heading, match.heading)) : 0.0;
  };
  const auto isFurther = [&](const LaneMatch& match) {
    return match.frenet.distance > matches.front().frenet.distance + params_.lane_keeping_error;
  };
  const auto last = std::find_if(matches.begin(), matches.end(), isFurther);
  double least = std::numeric_limits<double>::infinity();
  for (auto match = matches.begin(); match != last; ++match) least = std::min(least, turn(*match));
  std::vector<LanePoint> points;
  for (auto match = matches.begin(); match != last; ++match) {
    if (turn(*match) > least + params_.heading_error) continue;  // a lane that crosses there
    const double price = match->frenet.distance * params_.off_lane_price + turn(*match) * params_.off_heading_price;
    points.push_back({match->lane, match->frenet.s, price});
  }
  return points;
}

std::vector<LanePoint> LaneWayTool::fromPose(const Point2d& point, const std::optional<double>& heading,
                                             const std::string& name, const LaneHint& hint) const {
  if (!point.allFinite() || (heading && !std::isfinite(*heading))) throw InvalidRequest(text(name, " is not finite"));
  if (!hint.lane_id.empty()) requireLane(hint.lane_id, name);
  LaneQuery query;
  query.max_distance = heading ? params_.snap_distance : params_.max_goal_distance;
  query.heading = heading;
  query.max_heading_difference = params_.snap_heading;
  std::vector<LanePoint> points = candidates(point, query, hint);
  if (points.empty()) throw offMap(point, heading, name, hint);
  return points;
}

/// Why no lane was found.
OffMap LaneWayTool::offMap(const Point2d& point, const std::optional<double>& heading, const std::string& name,
                           const LaneHint& hint) const {
  const std::string place = heading ? at(Pose2d{point.x(), point.y(), *heading}) : at(point);
  std::optional<LaneMatch> nearest = map_.nearestLane(point, {});
  if (!nearest) return OffMap(text(name, " ", place, ": the map has no lane to drive on"));
  if (!hint.lane_id.empty()) {
    const LaneIndex lane = requireLane(hint.lane_id, name);
    const FrenetPoint frenet = map_.lane(lane).center.project(point);
    nearest = LaneMatch{lane, frenet, map_.lane(lane).center.headingAt(frenet.s)};
  }
  std::string difference;
  std::string limit = heading ? text(metres(params_.snap_distance), " (~snap_distance) and ",
                                     radians(params_.snap_heading), " (~snap_heading)")
                              : text(metres(params_.max_goal_distance), " (~max_goal_distance)");
  if (heading) {
    difference = text(", whose heading differs by ", radians(std::abs(angleBetween(*heading, nearest->heading))));
  }
  const double higher = hint.height ? heightDifference(map_, *nearest, *hint.height) : 0.0;
  if (higher > params_.height_error) {
    difference += text(difference.empty() ? ", whose" : " and", " height differs by ", metres(higher));
    limit += text(" and ", metres(params_.height_error), " (~height_error)");
  }
  const bool is_one = !heading && higher <= params_.height_error;
  return OffMap(text(name, " ", place, " is ", metres(nearest->frenet.distance), " from ",
                     hint.lane_id.empty() ? "the nearest lane " : "its lane ", map_.lane(nearest->lane).id, difference,
                     is_one ? "; the limit is " : "; the limits are ", limit));
}

LaneIndex LaneWayTool::requireLane(const std::string& id, const std::string& name) const {
  const auto index = map_.findLane(id);
  if (!index)
    throw InvalidRequest(
        text(name, " names lane ", quoted(id), ", which the map does not have", nearLaneIds(map_, id)));
  if (!map_.lane(*index).isDrivable())
    throw InvalidRequest(text(name, " names lane ", id, ", which is not for driving"));
  return *index;
}

LanePoint LaneWayTool::fromLane(const std::string& id, double s, const std::string& name) const {
  const LaneIndex index = requireLane(id, name);
  const Lane& lane = map_.lane(index);
  if (!(s >= -kBesideLane && s <= lane.length() + kBesideLane)) {  // catches NaN
    throw InvalidRequest(text(name, " has s ", s, " m; lane ", id, " goes from 0 to ", metres(lane.length())));
  }
  return {index, std::clamp(s, 0.0, lane.length())};
}

LaneQuery LaneWayTool::ownLanes(const Pose2d& vehicle) const {
  LaneQuery query;
  query.max_distance = params_.off_lane_distance;
  query.heading = vehicle.heading;
  query.max_heading_difference = params_.off_lane_heading;
  return query;
}

bool LaneWayTool::isOffLane(const Pose2d& vehicle, const std::optional<double>& height) const {
  return candidates(vehicle.position(), ownLanes(vehicle), {height, {}}).empty();
}

/// Where lanes give access to the area around `point`; none where it lies in none, or no lane does.
std::vector<LanePoint> LaneWayTool::fromArea(const Point2d& point) const {
  const Area* area = map_.areaAt(point);
  if (area == nullptr) return {};
  try {
    std::vector<LanePoint> points = accessPoints(map_, *area, params_.area_access_distance);
    for (LanePoint& access : points) access.price = (map_.lane(access.lane).center.pointAt(access.s) - point).norm();
    return points;
  } catch (const OffMap&) {
    return {};
  }
}

std::vector<LanePoint> LaneWayTool::fromVehicle(const Pose2d& vehicle, const std::optional<double>& height) const {
  if (!vehicle.isFinite()) throw InvalidRequest("the vehicle's pose is not finite");
  std::vector<LanePoint> points = candidates(vehicle.position(), ownLanes(vehicle), {height, {}});
  if (points.empty()) points = fromArea(vehicle.position());
  if (!points.empty()) return points;
  LaneQuery around;
  around.max_distance = params_.park_and_go_radius;
  const std::vector<LaneMatch> matches =
      height ? onDeck(vehicle.position(), around, *height) : map_.lanesWithin(vehicle.position(), around);
  for (const LaneMatch& match : matches) points.push_back({match.lane, match.frenet.s});
  if (!points.empty()) return points;
  const auto nearest = map_.nearestLane(vehicle.position(), {});
  throw OffMap(text("the vehicle at ", at(vehicle), " is off the lanes and ",
                    nearest ? text(metres(nearest->frenet.distance), " from the nearest, ", map_.lane(nearest->lane).id)
                            : "the map has none to drive on",
                    "; the limit is ", metres(params_.park_and_go_radius), " (~park_and_go_radius)"));
}

std::vector<LanePoint> LaneWayTool::fromParkingSpace(const std::string& id, bool* used_geometry) const {
  const ParkingSpace* space = map_.findParkingSpace(id);
  const std::string why_not = map_.whyUnusable(id);
  if (space == nullptr && !why_not.empty()) {
    throw InvalidRequest(
        text("parking_spot_id ", quoted(id), " cannot be used: in the map its polygon is wrong, ", why_not));
  }
  if (space == nullptr) {
    throw InvalidRequest(text("parking_spot_id ", quoted(id), " is none of the map's ", map_.parkingSpaces().size(),
                              " parking spaces", nearParkingSpaceIds(map_, id)));
  }
  Point2d middle = Point2d::Zero();
  for (const Point2d& corner : space->polygon.points()) middle += corner / space->polygon.points().size();
  std::vector<LanePoint> candidates;
  for (const LaneOverlap& overlap : space->lanes) {
    const Lane& lane = map_.lane(overlap.lane);
    if (lane.isDrivable()) candidates.push_back({overlap.lane, lane.center.project(middle).s});
  }
  if (used_geometry != nullptr) *used_geometry = candidates.empty();
  if (candidates.empty()) candidates = within(middle, params_.parking_lane_radius);
  if (!candidates.empty()) return candidates;
  throw OffMap(text("no lane to drive on lies within ", metres(params_.parking_lane_radius),
                    " (~parking_lane_radius) of parking space ", id, " at ", at(middle)));
}

std::vector<LanePoint> LaneWayTool::alongParkingSpace(const ParkingSpace& space, double max_gap) const {
  const BoundingBox& box = space.polygon.box();
  std::vector<LanePoint> points = within(0.5 * (box.min + box.max), params_.parking_lane_radius);
  const auto is_far = [&](const LanePoint& point) {
    const Lane& lane = map_.lane(point.lane);
    const Point2d nearest = lane.center.pointAt(point.s);
    if (space.polygon.contains(nearest)) return false;
    return space.polygon.distanceToBorder(nearest) - lane.widthAt(point.s) / 2.0 > max_gap;
  };
  points.erase(std::remove_if(points.begin(), points.end(), is_far), points.end());
  return points;
}

std::vector<LanePoint> LaneWayTool::within(const Point2d& point, double radius) const {
  LaneQuery query;
  query.max_distance = radius;
  std::vector<LanePoint> points;
  for (const LaneMatch& match : map_.lanesWithin(point, query)) points.push_back({match.lane, match.frenet.s});
  return points;
}

}  // namespace external_command
