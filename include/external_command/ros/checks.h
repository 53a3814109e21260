// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Point.h>
#include <ros/time.h>

#include <string>
#include <vector>

#include "external_command/LaneSegment.h"
#include "external_command/Pose.h"
#include "external_command/RoiPolygon.h"
#include "external_command/ros/request_limits.h"

namespace external_command {

/// Each throws InvalidRequest with the field's name, its value and what was expected.
void requireFinite(double value, const std::string& field);
void requireNotNegative(double value, const std::string& field);
/// A speed to drive at [m/s]: 0, which means not given, or kLeastSpeed at least.
void requireTargetSpeed(double value, const std::string& field = "target_speed");
void requireWithin(double value, double low, double high, const std::string& field);
/// @param limit  name of the parameter that sets `high`, where there is one.
void requireSize(std::size_t size, std::size_t low, std::size_t high, const std::string& field,
                 const std::string& limit = "");
void requireFinite(const Pose& pose, const std::string& field);                   ///< and within kCoordinate
void requireFinite(const geometry_msgs::Point& point, const std::string& field);  ///< the same; z is not looked at

/// For what goes on with the command, to readers who need not know that it has no meaning: numbers that are not used
/// must be finite, too.
void requireSendable(const Pose& pose, const std::string& field);
void requireSendable(const std::vector<Pose>& poses, const std::string& field);

/// The same for one of many points, `list[index]field`.
void requirePlace(const geometry_msgs::Point& point, const std::string& list, std::size_t index,
                  const std::string& field);

/// For commands that mean little later. A stamp that is not set passes.
/// @throws StaleRequest  the stamp differs from now by more than `max_age` [s], to either side.
void requireFresh(const ros::Time& stamp, double max_age);

void checkWayPoints(const std::vector<Pose>& way_points, bool is_start_pose_set, const RequestLimits& limits);
void checkBlackList(const std::vector<LaneSegment>& lanes, const std::vector<std::string>& roads,
                    const RequestLimits& limits);
/// Points that go on with the command: their z, which is not used, must be finite, too.
void checkPoints(const std::vector<geometry_msgs::Point>& points, std::size_t low, const std::string& field);
/// Their z is ignored, by whoever reads them.
void checkPolygon(const RoiPolygon& polygon, const std::string& field, const RequestLimits& limits);
void checkPolygons(const std::vector<RoiPolygon>& polygons, const std::string& field, const RequestLimits& limits);

}  // namespace external_command
