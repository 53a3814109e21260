// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "coverage_case.h"
#include "external_command/core/path.h"

namespace external_command {
namespace benchmark {

/// The path as [[x, y, theta, direction, tool], ...], tool 1 where the vehicle arrives working.
/// @throws std::runtime_error  the file cannot be written.
void writeCoveragePath(const Path& path, const std::string& file);

/// A drawing: what is swept light green, free but not swept red, holes grey; the path blue forward and orange in
/// reverse, bold where it works; the start's footprint black.
/// @throws std::runtime_error  the file cannot be written.
void drawCoverage(const CoverageCase& field, const Path& path, const std::string& file);

}  // namespace benchmark
}  // namespace external_command
