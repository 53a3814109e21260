// SPDX-License-Identifier: Apache-2.0
#include "external_command/motion/region.h"

#include <cmath>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/parameter_range.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr std::size_t kMaxCells = 64'000'000;

void validate(const OccupancyGrid& grid) {
  const std::string fault = gridFault(grid, grid.cells.size());
  if (!fault.empty()) throw InvalidRequest(fault);
}

void validate(const BoundingBox& box) {
  if (box.min.allFinite() && box.max.allFinite() && (box.min.array() < box.max.array()).all()) return;
  throw InvalidRequest(text("the axle bounds from ", at(box.min), " to ", at(box.max), " are empty or not finite"));
}

}  // namespace

std::string gridFault(const OccupancyGrid& grid, std::size_t cells) {
  if (!(grid.resolution >= 1e-3 && grid.resolution <= 100.0)) {
    return text("the grid's resolution is ", grid.resolution, " m; it must lie in [0.001, 100]");
  }
  if (!grid.origin.isFinite()) return "the grid's origin is not finite";
  const std::size_t wanted = static_cast<std::size_t>(grid.width) * grid.height;
  if (wanted == 0 || wanted > kMaxCells) {
    return text("the grid has ", grid.width, " x ", grid.height, " cells; it must have 1 to ", kMaxCells);
  }
  if (cells != wanted) {
    return text("the grid holds ", cells, " values; its size of ", grid.width, " x ", grid.height, " needs ", wanted);
  }
  if (grid.blocked_from < 1 || grid.blocked_from > 100) {
    return text("the grid's blocked_from is ", grid.blocked_from, "; it must lie in [1, 100]");
  }
  return "";
}

void RegionLimits::validate() const {
  requireParameter("max_edges", static_cast<double>(max_edges), 4.0, 1e8);
  requireParameter("max_near_edges", static_cast<double>(max_near_edges), 4.0, 1e9);
}

Region::Region(Parts parts) : parts_(std::move(parts)) {
  if (parts_.grid) validate(*parts_.grid);
  if (parts_.axle_bounds) validate(*parts_.axle_bounds);
}

}  // namespace external_command
