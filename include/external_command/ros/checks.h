// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Point.h>
#include <ros/time.h>

#include <string>
#include <vector>

#include "external_command/LaneSegment.h"
#include "external_command/Pose.h"
#include "external_command/RoiPolygon.h"

namespace external_command {

/// Sizes of requests beyond which they are refused.
struct RequestLimits {
  static constexpr std::size_t kWayPoints = 1000;
  static constexpr std::size_t kPathPoints = 100000;
  static constexpr std::size_t kBlackList = 10000;
  static constexpr std::size_t kPolygons = 1000;
  static constexpr std::size_t kPolygonPoints = 10000;
  static constexpr double kCoordinate = 1e9;  ///< to either side [m]; no map of the earth reaches further
};

/// Each throws InvalidRequest with the field's name, its value and what was expected.
void requireFinite(double value, const std::string& field);
void requireNotNegative(double value, const std::string& field);
void requireWithin(double value, double low, double high, const std::string& field);
void requireSize(std::size_t size, std::size_t low, std::size_t high, const std::string& field);
void requireFinite(const Pose& pose, const std::string& field);                   ///< and within kCoordinate
void requireFinite(const geometry_msgs::Point& point, const std::string& field);  ///< the same; z is not looked at

/// For commands that mean little later. A stamp that is not set passes.
/// @throws StaleRequest  the stamp differs from now by more than `max_age` [s], to either side.
void requireFresh(const ros::Time& stamp, double max_age);

void checkWayPoints(const std::vector<Pose>& way_points, bool is_start_pose_set);
void checkBlackList(const std::vector<LaneSegment>& lanes, const std::vector<std::string>& roads);
void checkPoints(const std::vector<geometry_msgs::Point>& points, std::size_t low, std::size_t high,
                 const std::string& field);
void checkPolygon(const RoiPolygon& polygon, const std::string& field);
void checkPolygons(const std::vector<RoiPolygon>& polygons, const std::string& field);

}  // namespace external_command
