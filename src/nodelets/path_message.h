// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Path.h>

#include "external_command/PathFollowCommand.h"

namespace external_command {

/// The command that a path means. Orientations become headings, except where nobody filled them in: all of them zero,
/// or all of them the identity while the path goes across that. A single one without direction becomes NaN. The poses'
/// own headers are not looked at.
PathFollowCommand toPathFollowCommand(const nav_msgs::Path& path);

}  // namespace external_command
