// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "external_command/core/path.h"
#include "parking_case.h"

namespace external_command {
namespace benchmark {

/// The case as readParkingCase() takes it.
/// @throws std::runtime_error  the file cannot be written.
void writeCase(const ParkingCase& task, const std::string& file);

/// The path as [[x, y, theta, direction], ...] in the frame of the case's file.
/// @throws std::runtime_error  the file cannot be written.
void writePath(const ParkingCase& task, const Path& path, const std::string& file);

/// A drawing: obstacles grey, footprints along the path, the path blue forward and red in reverse, the start's
/// footprint green, the goal's orange.
/// @throws std::runtime_error  the file cannot be written.
void writeDrawing(const ParkingCase& task, const Path& path, const std::string& file);

}  // namespace benchmark
}  // namespace external_command
