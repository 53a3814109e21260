// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <std_msgs/Header.h>

#include "external_command/PlanningCommand.h"
#include "external_command/core/path.h"
#include "external_command/ros/prepared_message.h"

namespace external_command {

/// The bytes of `command` with toMsg(`path`) as its points, written straight from `path`.
/// @param command  without points of its own.
PreparedBytes bytesOf(const PlanningCommand& command, const Path& path);

/// The bytes of `path` as a nav_msgs/Path, for ordinary ROS controllers and rviz. All its poses have the same header.
PreparedBytes navPathBytesOf(const Path& path, const std_msgs::Header& header);

}  // namespace external_command
