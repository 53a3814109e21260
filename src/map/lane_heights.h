// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/map/hd_map.h"

namespace external_command {

/// Heights along a line, one per point, as few of them as describe all to 0.1 m.
/// @return empty where the heights are not as many as the points, or not finite.
std::vector<HeightSample> heightProfile(const std::vector<Point2d>& line, const std::vector<float>& heights);

}  // namespace external_command
