// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <ros/service.h>

#include <utility>
#include <vector>

#include "external_command/CommandStatus.h"
#include "external_command/FreeSpace.h"
#include "external_command/RoiPolygon.h"
#include "external_command/ZoneCover.h"

namespace external_command {

inline RoiPolygon polygonOf(const std::vector<std::pair<double, double>>& corners) {
  RoiPolygon polygon;
  for (const auto& [x, y] : corners) {
    geometry_msgs::Point point;
    point.x = x;
    point.y = y;
    polygon.points.push_back(point);
  }
  return polygon;
}

/// Crosses itself.
inline RoiPolygon bowTie() { return polygonOf({{0.0, 0.0}, {30.0, 30.0}, {30.0, 0.0}, {0.0, 30.0}}); }

inline RoiPolygon boxOf(double x0, double y0, double x1, double y1) {
  return polygonOf({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

inline FreeSpace driveStraightOnTo(double x) {
  FreeSpace call;
  call.request.command.parking_spot_pose.x = x;
  call.request.command.parking_spot_pose.has_heading = 1;
  return call;
}

inline CommandStatus statusOf(FreeSpace call) {
  EXPECT_TRUE(ros::service::call("external_command/free_space", call));
  return call.response.status;
}

inline CommandStatus statusOf(ZoneCover call) {
  EXPECT_TRUE(ros::service::call("external_command/zone_cover", call));
  return call.response.status;
}

}  // namespace external_command
