// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/polygon.h"

namespace external_command {

/// What a sensor or a person gave as an obstacle: as Polygon's constructor, but points that all lie on one spot or on
/// one line (less than 1 mm across, or less than 1 cm^2 within 10 cm) are taken as a rectangle that reaches 1 cm beyond
/// them.
/// @throws InvalidRequest  as the constructor does.
Polygon obstaclePolygon(const std::vector<Point2d>& points, const std::string& name);

}  // namespace external_command
