// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "coverage/field/field.h"
#include "work.h"

namespace external_command {

/// Swaths along the straight line from `start` on for `length` [m], bent round the obstacles on it: a step aside as
/// late as the vehicle gets past, and one back as soon as it is past. One swath where all can be passed so; else the
/// line is cut at those that cannot. From either end an obstacle is passed on the same side.
/// @param step  between places of the line that are looked at [m].
std::vector<Work> evadingSwaths(const Field& field, const Pose2d& start, double length, double step);

}  // namespace external_command
