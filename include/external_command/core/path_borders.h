// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "external_command/core/waypoint_path.h"

namespace external_command {

/// The borders of a path: a point each per point of its line [m].
struct PathBorders {
  std::vector<Point2d> left;
  std::vector<Point2d> right;
};

/// How the borders lie at a point of the line, seen in the direction of driving.
struct BorderSides {
  std::size_t waypoint = 0;  ///< index in the line
  double left = 0.0;         ///< of the left border to the left of the line [m]; negative: to its right
  double right = 0.0;        ///< of the right border to the right of the line [m]; negative: to its left
};

/// The first place where the left border lies to the right of the line and the right one to its left. Where the line
/// has a corner, that counts against the ways on both sides of it. Where the vehicle reverses, `left` may mean the
/// path's or the vehicle's: such places are not looked at, nor is what lies within half a metre of the last that was.
/// Headings count where there is one per point.
/// @pre  the borders have as many points as the line.
std::optional<BorderSides> swappedBorders(const WaypointLine& line, const PathBorders& borders);

/// The same for one border alone on the wrong side: the line leaves its borders.
std::optional<BorderSides> crossedBorder(const WaypointLine& line, const PathBorders& borders);

}  // namespace external_command
