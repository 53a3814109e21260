// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

/// Whether a vehicle at `start` is beside the point `first` of the line, or turned against it, by more than millimetres
/// and milliradians.
bool isBeside(const Pose2d& start, const std::vector<Point2d>& line, std::size_t first);

/// Shifts a line of points `step` [m] apart so that point `first` is where the vehicle is, the points before it lie
/// straight behind the vehicle, and those after it go over to the line as it was, ever more slowly (quintic in place
/// and direction), over 10 m or as many as a vehicle of curvature `max_kappa` [1/m] needs for that. Point `last` stays.
void mergeFrom(const Pose2d& start, std::size_t first, std::size_t last, double step, double max_kappa,
               std::vector<Point2d>* line);

}  // namespace external_command
