// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <optional>

#include "command_draft.h"
#include "external_command/PlannedPath.h"

namespace external_command {

/// What rviz shows of a draft: goal, points, the outline of the chosen object, and the path of a dry run. In the frame
/// `map`. What there is not is deleted from the display.
visualization_msgs::MarkerArray draftMarkers(const CommandDraft& draft, const std::optional<MapObject>& object,
                                             const PlannedPath& path);

}  // namespace external_command
