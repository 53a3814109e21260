// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/checks.h"

#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/core/vehicle.h"

namespace external_command {

namespace {

bool isCoordinate(double value) { return std::abs(value) <= RequestLimits::kCoordinate; }  // false for NaN

void requireCoordinate(double value, const std::string& field) {
  requireFinite(value, field);
  requireWithin(value, -RequestLimits::kCoordinate, RequestLimits::kCoordinate, field);
}

}  // namespace

void requireFinite(double value, const std::string& field) {
  if (!std::isfinite(value)) throw InvalidRequest(text(field, " is ", value, "; it must be finite"));
}

void requireNotNegative(double value, const std::string& field) {
  requireFinite(value, field);
  if (value < 0.0) throw InvalidRequest(text(field, " is ", value, "; it must not be negative"));
}

void requireTargetSpeed(double value, const std::string& field) {
  requireNotNegative(value, field);
  if (value == 0.0 || value >= kLeastSpeed) return;
  throw InvalidRequest(text(field, " is ", value, " m/s; it must be 0, which means not given, or ", kLeastSpeed,
                            " at least (to halt: the action STOP)"));
}

void requireWithin(double value, double low, double high, const std::string& field) {
  if (value >= low && value <= high) return;  // false for NaN
  throw InvalidRequest(text(field, " is ", value, "; it must lie in [", low, ", ", high, "]"));
}

void requireSize(std::size_t size, std::size_t low, std::size_t high, const std::string& field,
                 const std::string& limit) {
  if (size >= low && size <= high) return;
  throw InvalidRequest(text(field, " has ", size, " elements; it must have ", low, " to ", high,
                            limit.empty() ? "" : " (~requests/" + limit + ")"));
}

void requireFinite(const Pose& pose, const std::string& field) {
  requireCoordinate(pose.x, field + ".x");
  requireCoordinate(pose.y, field + ".y");
  if (pose.has_heading) requireFinite(pose.heading, field + ".heading");
  if (pose.has_z) requireCoordinate(pose.z, field + ".z");
}

void requireFinite(const geometry_msgs::Point& point, const std::string& field) {
  requireCoordinate(point.x, field + ".x");
  requireCoordinate(point.y, field + ".y");
}

void requireSendable(const Pose& pose, const std::string& field) {
  requireFinite(pose, field);
  requireFinite(pose.heading, field + ".heading");
  requireFinite(pose.z, field + ".z");
}

void requireSendable(const std::vector<Pose>& poses, const std::string& field) {
  for (std::size_t i = 0; i < poses.size(); ++i) requireSendable(poses[i], text(field, "[", i, "]"));
}

void requirePlace(const geometry_msgs::Point& point, const std::string& list, std::size_t index,
                  const std::string& field) {
  if (isCoordinate(point.x) && isCoordinate(point.y)) return;  // names take longer to make than points to check
  requireFinite(point, text(list, "[", index, "]", field));
}

void requireFresh(const ros::Time& stamp, double max_age) {
  if (stamp.isZero()) return;
  const double age = ros::Time::now().toSec() - stamp.toSec();  // a ros::Duration holds 68 years only
  if (age > max_age) {
    throw StaleRequest(text("header.stamp is ", seconds(age), " old; the limit is ", seconds(max_age),
                            " (~max_request_age): send it again, or leave the stamp empty"));
  }
  if (age < -max_age) {
    throw StaleRequest(text("header.stamp lies ", seconds(-age), " in the future; the limit is ", seconds(max_age),
                            " (~max_request_age): do the clocks agree?"));
  }
}

void checkWayPoints(const std::vector<Pose>& way_points, bool is_start_pose_set, const RequestLimits& limits) {
  requireSize(way_points.size(), 0, limits.max_way_points, "way_point", "max_way_points");
  if (is_start_pose_set && way_points.empty()) {
    throw InvalidRequest("way_point is empty, but is_start_pose_set says that its first is the start");
  }
  for (std::size_t i = 0; i < way_points.size(); ++i) requireFinite(way_points[i], text("way_point[", i, "]"));
}

void checkBlackList(const std::vector<LaneSegment>& lanes, const std::vector<std::string>& roads,
                    const RequestLimits& limits) {
  requireSize(lanes.size(), 0, limits.max_black_list, "blacklisted_lane", "max_black_list");
  requireSize(roads.size(), 0, limits.max_black_list, "blacklisted_road", "max_black_list");
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    requireFinite(lanes[i].start_s, text("blacklisted_lane[", i, "].start_s"));
    requireFinite(lanes[i].end_s, text("blacklisted_lane[", i, "].end_s"));
  }
}

void checkPoints(const std::vector<geometry_msgs::Point>& points, std::size_t low, const std::string& field) {
  if (points.size() < low) {
    throw InvalidRequest(text(field, " has ", points.size(), " elements; it must have ", low, " at least"));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    requirePlace(points[i], field, i, "");
    if (!std::isfinite(points[i].z)) requireFinite(points[i].z, text(field, "[", i, "].z"));
  }
}

void checkPolygon(const RoiPolygon& polygon, const std::string& field, const RequestLimits& limits) {
  requireSize(polygon.points.size(), 3, limits.max_polygon_points, field + ".points", "max_polygon_points");
  for (std::size_t i = 0; i < polygon.points.size(); ++i) requirePlace(polygon.points[i], field + ".points", i, "");
}

void checkPolygons(const std::vector<RoiPolygon>& polygons, const std::string& field, const RequestLimits& limits) {
  requireSize(polygons.size(), 0, limits.max_polygons, field, "max_polygons");
  for (std::size_t i = 0; i < polygons.size(); ++i) checkPolygon(polygons[i], text(field, "[", i, "]"), limits);
}

}  // namespace external_command
