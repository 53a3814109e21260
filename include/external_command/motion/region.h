// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/polygon.h"
#include "external_command/core/pose.h"

namespace external_command {

/// Obstacles seen by sensors, the meaning of `nav_msgs/OccupancyGrid`.
struct OccupancyGrid {
  double resolution = 0.0;          ///< side of a cell [m]
  std::uint32_t width = 0;          ///< cells along the grid's x
  std::uint32_t height = 0;         ///< cells along the grid's y
  Pose2d origin;                    ///< of the outer corner of cell (0, 0); the heading turns the whole grid
  std::vector<std::int8_t> cells;   ///< row by row along x: -1 unknown, 0 free ... 100 occupied
  int blocked_from = 50;            ///< cells with this value or more are obstacles, in [1, 100]
  bool unknown_is_blocked = true;   ///< cells below 0 are obstacles
  bool outside_is_blocked = false;  ///< so is everything beyond the grid
};

/// What is wrong with the size, resolution or origin of a grid that has `cells` values, whatever `grid.cells` holds;
/// empty where it can be used. Takes no time that grows with the grid.
std::string gridFault(const OccupancyGrid& grid, std::size_t cells);

/// How much memory a region may take while it is planned in.
struct RegionLimits {
  std::size_t max_edges = 2'000'000;        ///< of all obstacles and borders, [4, 100000000]
  std::size_t max_near_edges = 32'000'000;  ///< those within the vehicle's reach, in sum over cells of half a metre or
                                            ///< more, short ones side by side counted as one; 12 bytes each,
                                            ///< [4, 1000000000]

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

/// Where a vehicle may be. Immutable and thread-safe; far from the origin nothing is lost.
class Region {
 public:
  /// Every part may be left out.
  struct Parts {
    std::optional<Polygon> drivable;         ///< the whole footprint stays inside; left out: no border
    std::vector<Polygon> non_drivable;       ///< filled obstacles
    std::optional<OccupancyGrid> grid;       ///< further obstacles
    std::optional<BoundingBox> axle_bounds;  ///< the rear-axle centre stays inside this box
    RegionLimits limits;                     ///< beyond which those who plan in it refuse it
  };

  /// No border, no obstacle.
  Region() = default;

  /// @throws InvalidRequest  the grid has a gridFault(), or the box is empty: the text says which.
  explicit Region(Parts parts);

  const std::optional<Polygon>& drivable() const { return parts_.drivable; }
  const std::vector<Polygon>& nonDrivable() const { return parts_.non_drivable; }
  const std::optional<OccupancyGrid>& grid() const { return parts_.grid; }
  const std::optional<BoundingBox>& axleBounds() const { return parts_.axle_bounds; }
  const RegionLimits& limits() const { return parts_.limits; }

 private:
  Parts parts_;
};

}  // namespace external_command
