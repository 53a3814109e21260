// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "external_command/Pose.h"
#include "external_command/RoutingRequest.h"
#include "external_command/ros/process_context.h"
#include "external_command/routing/router.h"

namespace external_command {

/// What convert() makes of a command that drives lanes.
struct RoutingTask {
  RouteQuery query;
  std::optional<Route> route;         ///< of `query`, where it was searched already
  std::optional<Pose2d> vehicle;      ///< where the path begins, if it begins at the vehicle
  RoutingRequest request;             ///< the same as a message, with the nearest of several candidates
  std::vector<Point2d> way_points;    ///< for the display
  std::vector<std::string> warnings;  ///< for the report
};

/// Start and way points of a command, the goal still missing.
/// With `is_start_pose_set` the first of `way_points` is the start; otherwise `vehicle` is.
/// @param frame_id  of the way points.
/// @throws NotReady  no map, or no vehicle pose. @throws OffMap, InvalidRequest
RoutingTask beginRoutingTask(const ProcessContext& context, const PlanStart& vehicle, const std::string& frame_id,
                             bool is_start_pose_set, const std::vector<Pose>& way_points);

/// Lanes, parts of lanes and roads that may not be driven.
/// @throws InvalidRequest  an unknown id, or a part that is none.
void addBlackList(const HdMap& map, const std::vector<LaneSegment>& lanes, const std::vector<std::string>& roads,
                  RoutingTask* task);

/// The lanes that `pose` may mean as goals.
/// @throws OffMap
void setGoal(const ProcessContext& context, const std::string& frame_id, const Pose& pose, const std::string& field,
             RoutingTask* task);

/// Any of `candidates` as goal; the request names the first.
void setGoals(const HdMap& map, const std::vector<LanePoint>& candidates, RoutingTask* task);

/// The request with the candidates that `route` took as its way points.
RoutingRequest requestOf(const HdMap& map, const RoutingTask& task, const Route& route);

}  // namespace external_command
