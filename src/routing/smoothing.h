// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

/// Kinks of the centre lines are rounded, and noise is taken out, over about this length [m]. The path then stays
/// within 4 cm of a line that is sampled at 0.1 rad per point.
constexpr double kSmoothingLength = 1.2;

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();  ///< of a number of points

/// Smooths a curve of evenly spaced points: minimizes the squared distances to the given points plus
/// `scale`^6 times the squared third differences (a discrete smoothing spline, Whittaker 1923), which leaves circles
/// as they are and takes out what is shorter than some `scale` points (at most 30). The points `first` and `last` stay
/// where they are, but for kNone. O(n).
void smooth(double scale, std::size_t first, std::size_t last, std::vector<Point2d>* points);

}  // namespace external_command
