// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "external_command/ros/map_part.h"

namespace external_command {

/// Lane surfaces, centre lines, boundaries, junctions, parking spaces, areas: a namespace each, of one marker with many
/// points. What the part has none of is deleted from the display.
visualization_msgs::MarkerArray mapMarkers(const MapPart& part, const std::string& frame);

/// The ids of lanes, parking spaces and areas as texts, in namespaces `lane_ids`, `parking_space_ids` and `area_ids`. A
/// lane of both directions has one text.
visualization_msgs::MarkerArray idMarkers(const MapPart& part, const std::string& frame);

/// What the colours mean, and a scale, below the part: namespace `legend`.
visualization_msgs::MarkerArray legendMarkers(const MapPart& part, const std::string& frame);

}  // namespace external_command
