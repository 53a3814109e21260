// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/polygon.h"
#include "free_space/manoeuvre.h"

namespace external_command {

/// What a search covers: all obstacles, and room to turn around them, as far as the rear axle may go.
BoundingBox searchArea(const Scene& scene, const Query& query);

/// Where a part of a way is searched anew: the smallest box around `points`, not empty, larger by `room` [m] to each
/// side, within `area`.
BoundingBox searchBox(const std::vector<Point2d>& points, double room, const BoundingBox& area);

}  // namespace external_command
