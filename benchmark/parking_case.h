// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "external_command/core/vehicle.h"
#include "external_command/motion/region.h"

namespace external_command {
namespace benchmark {

/// A free-space task: from where to where, with what, past what.
struct ParkingCase {
  std::string name;
  VehicleParams vehicle;
  Point2d origin{0.0, 0.0};  ///< of everything below in the file's frame: some cases lie billions of metres away
  Pose2d start;
  Pose2d goal;
  Region region;
};

/// A JSON object with `name`, `vehicle` {wheelbase, width, front_overhang, rear_overhang, min_turning_radius or
/// max_steer}, `start` and `goal` [x, y, theta] of the rear-axle centre, `bounds` [xmin, ymin, xmax, ymax] in which
/// that stays, and `obstacles` [[[x, y], ...], ...]. A point or a line is an obstacle too, see obstaclePolygon(); what
/// crosses itself is replaced by its convex hull.
/// @throws std::runtime_error  the file cannot be read; the text names file and field.
ParkingCase readParkingCase(const std::string& file);

/// The files themselves, and all `*.json` of the folders among them but `best_known.json`, sorted.
/// @throws std::runtime_error  there is no such file or folder.
std::vector<std::string> parkingCaseFiles(const std::vector<std::string>& files_and_folders);

/// Costs by case name from a `best_known.json` beside `file`; empty where there is none.
std::map<std::string, double> bestKnownCosts(const std::string& file);

}  // namespace benchmark
}  // namespace external_command
