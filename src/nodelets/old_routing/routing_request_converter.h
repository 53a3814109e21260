// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "external_command/LaneFollowCommand.h"
#include "external_command/RoutingRequest.h"
#include "external_command/ValetParkingCommand.h"
#include "external_command/ros/process_context.h"

namespace external_command {

/// Turns legacy routing requests into commands with poses in the map frame. Const and thread-safe.
///
/// The first way point is where the vehicle was when the request was made: it is dropped, unless
/// `is_start_pose_set` makes it the start, or it is the only one, and then the end.
class RoutingRequestConverter {
 public:
  /// @param tolerance  how far a way point's position and its lane and s may lie apart [m].
  RoutingRequestConverter(std::shared_ptr<const ProcessContext> context, double tolerance)
      : context_(std::move(context)), tolerance_(tolerance) {}

  /// The last way point becomes the end.
  /// @throws InvalidRequest  no way point to drive to, an unknown lane, position and lane that disagree ...
  /// @throws NotReady        a way point names a lane, but there is no map.
  LaneFollowCommand toLaneFollow(const RoutingRequest& request) const;

  /// The parking space is the end, in place of the last way point.
  /// @throws  as toLaneFollow(); InvalidRequest also where the parking space has no id.
  ValetParkingCommand toValetParking(const RoutingRequest& request) const;

 private:
  /// The frame of a request, in the map frame.
  struct GivenFrame {
    Pose2d pose;
    double z = 0.0;  ///< [m]
  };

  /// `waypoint[i]` for the i in [begin, end).
  std::vector<Pose> toPoses(const RoutingRequest& request, std::size_t begin, std::size_t end) const;
  Pose toPose(const LaneWaypoint& way_point, const GivenFrame& frame, const std::string& name) const;
  Pose onLane(const LaneWaypoint& way_point, const Pose2d& frame, const std::string& name) const;
  LanePoint lanePoint(const LaneWaypoint& way_point, const Pose2d& frame, const std::string& name) const;

  const std::shared_ptr<const ProcessContext> context_;
  const double tolerance_;
};

/// True where the request asks for a parking space.
bool hasParkingInfo(const RoutingRequest& request);

}  // namespace external_command
