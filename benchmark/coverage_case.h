// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../test/support/vehicles.h"
#include "external_command/coverage/coverage_planner.h"

namespace external_command {
namespace benchmark {

using Ring = std::vector<Point2d>;  ///< the first point not repeated

/// A field to be swept, and with what.
struct CoverageCase {
  std::string name;         ///< fit for a file name
  std::vector<Ring> rings;  ///< the border, then the holes
  double swath_width = 0.0;
  VehicleParams vehicle;
  std::optional<Pose2d> start;

  /// @throws InvalidRequest  a ring is no simple polygon; the text names field and vertex.
  CoverageArea area() const;
};

constexpr double kTractorSwath = 4.0;  ///< of a tractor(), for what a file leaves out [m]

/// The polygons of a GeoJSON file (FeatureCollection, Feature or bare geometry; of a MultiPolygon, each), planar
/// coordinates [m]. Properties, each of which may be left out: `name`, `swath_width`, `start` [x, y, theta] of the
/// rear-axle centre, `vehicle` {wheelbase, width, front_overhang, rear_overhang, min_turning_radius or max_steer}.
/// @param skipped  gets a text for each thing in it that is no polygon.
/// @throws std::runtime_error  the file cannot be read; the text names file, feature and reason.
std::vector<CoverageCase> readCoverageCases(const std::string& file, std::vector<std::string>* skipped);

/// As a file of one GeoJSON feature.
/// @throws std::runtime_error  the file cannot be written.
void writeCoverageCase(const CoverageCase& field, const std::string& file);

}  // namespace benchmark
}  // namespace external_command
