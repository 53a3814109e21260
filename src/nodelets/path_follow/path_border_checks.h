// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/PathFollowCommand.h"

namespace external_command {

/// @throws InvalidRequest  boundaries and widths, one of either, boundaries of another size than the path, or on each
///                         other's side of it.
void checkBorders(const PathFollowCommand& command);

/// Where the path leaves its borders, and where they leave less room than the vehicle's width [m].
void warnOfBorders(const PathFollowCommand& command, double vehicle_width, std::vector<std::string>* warnings);

}  // namespace external_command
