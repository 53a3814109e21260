// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path_bounds.h"

#include "external_command/core/error.h"
#include "external_command/core/parameter_range.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kLongest = 1e7;  // [m]
constexpr double kMostPoints = 1e7;

}  // namespace

void PathBounds::validate() const {
  requireParameter("max_path_length", max_length, 1.0, kLongest);
  requireParameter("max_path_start_distance", max_start_distance, 0.0, kLongest);
  requireParameter("max_path_points", static_cast<double>(max_points), 2.0, kMostPoints);
}

void PathBounds::require(double length, double points) const {
  if (!(length <= max_length)) {  // catches NaN
    throw InvalidRequest(text("the path is too long: ", length < kLongest ? metres(length) : text(length, " m"),
                              "; the limit is ", metres(max_length), " (~routing/max_path_length)"));
  }
  if (!(points <= static_cast<double>(max_points))) {
    throw InvalidRequest(text("the path has too many points: ", points, "; the limit is ", max_points,
                              " (~routing/max_path_points); a wider ~routing/path_spacing takes fewer"));
  }
}

void PathBounds::require(const Path& path) const {
  if (!path.empty()) require(path.back().s, static_cast<double>(path.size()));
}

}  // namespace external_command
