// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Path.h>

#include <functional>
#include <string>

#include "external_command/PathFollowCommand.h"
#include "external_command/core/pose.h"

namespace external_command {

/// The pose of a frame in the map's. @throws InvalidRequest  it is not known.
using FrameLookup = std::function<Pose2d(const std::string& frame)>;

/// The command that a path means.
///
/// Frames: each pose's own, the path's where that is empty. Where all poses have the same one, so has the command; else
/// it is in the map frame.
///
/// Orientations become headings. Many planners (navfn, for example) fill in none but the last, the goal's: where all
/// others are the identity, or all zeros, the path has no headings, and the last is the heading to end with, unless it
/// is one of these too. Of quaternions only the direction counts, not the length. Stamps are not looked at.
/// @throws InvalidRequest  a position is no coordinate of a map; an orientation is not finite, or is zero between others
///                         that are not; a frame is not known. The text names the pose as `poses[i]`.
PathFollowCommand toPathFollowCommand(const nav_msgs::Path& path, const FrameLookup& pose_of);

}  // namespace external_command
