// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "coverage_case.h"
#include "external_command/core/path.h"

namespace external_command {
namespace benchmark {

/// What a path sweeps, and whether a vehicle can drive it inside the field.
struct CoverageCheck {
  double free_area = 0.0;          ///< border without holes [m^2]
  double reachable_area = 0.0;     ///< of it, as in reachable_area.h [m^2]
  double covered_free = 0.0;       ///< swept share of the free area
  double covered_reachable = 0.0;  ///< swept share of the reachable area
  double overlap = 0.0;            ///< swept again, over swept
  double length = 0.0;             ///< driven [m]
  double length_ratio = 0.0;       ///< over that of strips side by side with the same swept area; 0: nothing is swept
  std::size_t turns = 0;           ///< stretches with the tool off between two with the tool on
  std::size_t gear_changes = 0;
  std::size_t outside = 0;          ///< poses, no corner of the footprint moves more than 10 cm between them
  double max_curvature = 0.0;       ///< over any half metre [1/m]
  std::vector<std::string> faults;  ///< what is wrong with the path, where, by how much; none: it is drivable
};

/// Measures a path by nothing but the poses, gears and tool states of its points; between two points the vehicle moves
/// at constant rates. The footprint is 1 cm smaller all round.
CoverageCheck checkCoverage(const CoverageCase& field, const Path& path);

/// The corners of strips of the tool's width that together are what the path sweeps.
std::vector<std::array<Point2d, 4>> sweptStrips(const Path& path, double width);

}  // namespace benchmark
}  // namespace external_command
