// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

constexpr double kMinPolygonArea = 1e-4;  // [m^2]

/// Of a closed ring, the first point not repeated, positive counter-clockwise [m^2]; 0 for fewer than three points.
double signedArea(const std::vector<Point2d>& ring);

}  // namespace external_command
