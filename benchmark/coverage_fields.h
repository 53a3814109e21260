// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "external_command/core/vehicle.h"
#include "external_command/coverage/coverage_planner.h"

namespace external_command {
namespace benchmark {

/// A field to be swept, and with what.
struct FieldCase {
  std::string name;
  std::vector<std::vector<Point2d>> rings;  ///< the border, then the holes
  double swath_width = 0.0;
  std::optional<Pose2d> start;
  VehicleParams vehicle;

  CoverageArea area() const;
};

/// The Polygon features of a GeoJSON file: planar coordinates [m], optional properties `name`, `swath_width`, `start`
/// [x, y, theta] and `vehicle` {wheelbase, width, front_overhang, rear_overhang, min_turning_radius or max_steer}.
/// @throws std::runtime_error  the file cannot be read; the text says why.
std::vector<FieldCase> readFields(const std::string& file);

/// The field as one GeoJSON feature.
std::string toGeoJson(const FieldCase& field);

/// Rectangles, L, U, rings, fields with columns or a narrow neck, and `random` concave ones with holes, 30 m to 1 km
/// across; the same for the same seed.
std::vector<FieldCase> makeFields(unsigned seed, int random);

}  // namespace benchmark
}  // namespace external_command
