// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Point.h>

#include <string>
#include <vector>

#include "external_command/PlannedPath.h"
#include "external_command/Pose.h"
#include "external_command/RoiPolygon.h"
#include "external_command/RoutingResponse.h"
#include "external_command/core/cancel_token.h"
#include "external_command/core/path.h"
#include "external_command/core/polygon.h"
#include "external_command/routing/router.h"

namespace external_command {

/// A message's pose in the map frame: `frame` is the pose of the message's frame there.
Pose2d toMapPose(const Pose& pose, const Pose2d& frame);
Point2d toMapPoint(const geometry_msgs::Point& point, const Pose2d& frame);
std::vector<Point2d> toMapPoints(const std::vector<geometry_msgs::Point>& points, const Pose2d& frame);

/// @throws InvalidRequest  not a simple polygon; the text begins with `name`.
Polygon toPolygon(const RoiPolygon& roi, const Pose2d& frame, const std::string& name);

/// The obstacles of a request, which may be points and lines, see obstaclePolygon(): "non_drivable_roi[0]" and so on.
/// @throws InvalidRequest  not a simple polygon; the text begins with its name.
/// @throws Cancelled
std::vector<Polygon> toObstacles(const std::vector<RoiPolygon>& non_drivable_roi, const Pose2d& frame,
                                 const CancelToken& cancel);

geometry_msgs::Point toPointMsg(const Point2d& point);
PlannedPath toMsg(const Path& path);

/// Roads and passages of the route, without header, request and map version.
RoutingResponse toRoutingResponse(const HdMap& map, const Route& route);

}  // namespace external_command
