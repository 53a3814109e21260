// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bend_relief.h"
#include "external_command/routing/reference_path.h"

namespace external_command {

/// Where a corner of the vehicle, or its side at the rear axle, leaves the lanes, neighbours in the same direction
/// included: the worst place of each stretch, in order. Where the path has yet to get onto its course nothing is said,
/// and lanes narrower than the vehicle count as wide enough.
/// @param course, layout, wished  as those of BendRelief; `layout` has a place for each point of `path`.
std::vector<LeftLane> leftLanes(const Corridor& corridor, const VehicleParams& vehicle,
                                const std::vector<CoursePoint>& course, const std::vector<Point2d>& wished,
                                const CourseLayout& layout, const Path& path);

}  // namespace external_command
