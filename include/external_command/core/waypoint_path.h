// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/path_bounds.h"

namespace external_command {

/// What refusals call the points of a line.
struct WaypointNames {
  std::string point = "way_point";  ///< for `way_point[i]`
  std::string heading = "heading";  ///< for `heading[i]`
  std::string end_heading = "end_heading";
};

/// Points that a path passes through, in order. One that lies within 1 mm of the one before repeats it: both are one
/// place, and the heading given last is its.
struct WaypointLine {
  std::vector<Point2d> points;                       ///< [m], at least two places
  std::vector<double> headings = {};                 ///< of the vehicle, one per point [rad]; empty: driven forward
  std::optional<double> end_heading = std::nullopt;  ///< wished for at the last point, where `headings` is empty [rad]
  WaypointNames names = {};
};

/// The points `first` to `last` of a list, which are one place.
struct WaypointPlace {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The places that `points` name, in order.
std::vector<WaypointPlace> placesOf(const std::vector<Point2d>& points);

/// A stretch that bends more than the vehicle can, at its tightest place.
struct TightBend {
  std::size_t waypoint = 0;  ///< index of the nearest point of the line
  Point2d position;          ///< [m]
  double radius = 0.0;       ///< of the bend [m]
  double corner = 0.0;       ///< turn on the spot, where the line has a corner there [rad]; 0: it is a smooth bend
};

struct WaypointPath {
  Path path;
  std::vector<TightBend> tight_bends;  ///< in order along the path
  double end_turn = 0.0;  ///< from the heading at the path's end to a wished one that it cannot end with [rad]
};

/// @throws InvalidRequest  fewer than two places; a point that is not finite; a heading across the line (the text
///                         names it by `line.names`); a path beyond `bounds`.
void checkWaypoints(const WaypointLine& line, double spacing, const PathBounds& bounds = {});

/// Path of the rear-axle centre through every point of `line`, at most `spacing` [m] between two of its points.
///
/// Where the line bends gently the path is smooth: cubic Hermite pieces that leave the straight line by 0.25 m at each
/// end at most. Where it turns by more than that allows, it has a corner, and the path keeps to it. The vehicle
/// reverses from one point to the next where its headings there point against the motion. It ends with a wished
/// `end_heading` where that takes no bend that is too tight for the vehicle; else as if none were wished.
///
/// Its speed is capped by `target_speed` [m/s] (0: not given).
/// @throws InvalidRequest  as checkWaypoints().
/// @throws Cancelled  `cancel` was raised.
WaypointPath pathThrough(const WaypointLine& line, const VehicleParams& vehicle, double spacing, double target_speed,
                         const PathBounds& bounds = {}, const CancelToken& cancel = {});

}  // namespace external_command
