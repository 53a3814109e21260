// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

/// Two edges of a closed line that have more in common than a vertex that is both's, by their first vertices; nullopt
/// for a simple polygon. What is nearer than a micrometre touches. O(n log n), whatever the shape.
/// @param points  plausible, consecutive ones, last and first too, at least a millimetre apart.
std::optional<std::pair<std::size_t, std::size_t>> meetingEdges(const std::vector<Point2d>& points);

}  // namespace external_command
