// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/path.h"
#include "external_command/routing/router.h"

namespace external_command {

/// What a command has to show; all in the map frame [m, rad]. Empty parts are not drawn.
struct CommandScene {
  std::optional<Route> route;
  std::shared_ptr<const Path> path;  ///< nullptr: none
  std::optional<Pose2d> start;
  std::vector<Point2d> way_points;
  std::optional<Pose2d> goal;
  std::vector<std::vector<Point2d>> regions;    ///< drivable polygons
  std::vector<std::vector<Point2d>> obstacles;  ///< non-drivable polygons
  std::vector<std::vector<Point2d>> conflicts;  ///< what stood in the way, or was left uncovered
  bool with_footprints = false;                 ///< draw the vehicle's footprint along the path
};

/// The vehicle's outline, and round it a ring that points ahead, to be seen from high above: namespaces `footprint` and
/// `vehicle_ring`. rviz moves them along with `base_frame`.
/// @param ring_radius  [m]
visualization_msgs::MarkerArray vehicleMarkers(const VehicleParams& vehicle, const std::string& base_frame,
                                               double ring_radius);

/// The scene of one command. Parts that are empty are deleted from the display.
/// @param map  that of the scene's route; may be nullptr where it has none.
visualization_msgs::MarkerArray commandMarkers(const CommandScene& scene, const HdMap* map,
                                               const VehicleParams& vehicle, const std::string& frame);

}  // namespace external_command
