// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/path.h"
#include "external_command/core/polygon.h"
#include "external_command/core/vehicle.h"
#include "external_command/coverage/coverage_params.h"
#include "external_command/coverage/coverage_progress.h"
#include "external_command/motion/region.h"

namespace external_command {

/// What is to be swept. Holes may touch or cross the border and each other: what is free is `outer` without all of
/// them.
struct CoverageArea {
  Polygon outer;
  std::vector<Polygon> holes;
  /// What it blocks are holes too.
  std::optional<OccupancyGrid> grid = std::nullopt;
  RegionLimits limits = {};
};

/// A line, or the rest of one that was begun, on the path.
struct Swath {
  std::size_t index = 0;        ///< in CoverageResult::lines
  std::size_t first = 0;        ///< its first point in CoverageResult::path
  std::size_t last = 0;         ///< its last point; the vehicle arrives working at first + 1 ... last
  double from = 0.0;            ///< where on the line it begins [m]
  double length = 0.0;          ///< from there to the end of the line [m]
  double covered_area = 0.0;    ///< that it adds to what the swaths before it on the path have swept [m^2]
  std::vector<double> covered;  ///< of it, up to each of the points first ... last [m^2]
};

struct CoverageResult {
  Path path;                     ///< of the rear-axle centre; `tool_on` where it arrives working; speeds are caps
  std::vector<Swath> swaths;     ///< in the order of the path
  std::vector<SwathLine> lines;  ///< all laps and swaths of the plan in their order, those that are done included

  double coverage_ratio = 0.0;                  ///< swept share of what the vehicle can reach from the start
  double covered_free = 0.0;                    ///< swept share of the whole free area
  double free_area = 0.0;                       ///< outer without holes [m^2]
  double reachable_area = 0.0;                  ///< [m^2]
  double covered_area = 0.0;                    ///< swept, within the free area [m^2]
  double overlap = 0.0;                         ///< swept more than once, as share of what is swept
  std::vector<std::vector<Point2d>> uncovered;  ///< outlines of the larger free parts that stay unswept

  double length = 0.0;          ///< driven [m]
  double working_length = 0.0;  ///< of it with the tool on [m]
  unsigned turns = 0;           ///< stretches with the tool off between two with the tool on
  unsigned gear_changes = 0;
  double planning_time = 0.0;  ///< wall clock [s]
  std::vector<std::string> warnings;
};

/// Plans a path that sweeps an area and keeps the whole footprint inside it. Thread-safe: const, no shared state.
///
/// Laps run along the border and the larger holes, swaths fill what they leave, bent round small holes; turns and
/// transfers are Reeds-Shepp curves, or a search where none of those fits. Length is traded against coverage by a price
/// per square metre left out.
class CoveragePlanner {
 public:
  /// @throws InvalidParameter  a value of `vehicle` or `params` is out of range.
  CoveragePlanner(const VehicleParams& vehicle, const CoverageParams& params);

  /// @param start     pose of the vehicle; not given: the path begins with its first swath.
  /// @param progress  to go on with an earlier plan, in the same area; it may have new holes since. The ratios
  ///                  then tell of the whole plan, the path and the lengths of what is still to be done. Of a line that
  ///                  was begun the rest is driven, from where it was left or a little before.
  /// @param checked   called once area, start and progress are found usable, before what takes long.
  /// @throws InvalidRequest   the area is smaller than the vehicle, a hole leaves nothing of it, it is too large, or
  ///                          `progress` is not plausible (requirePlausible).
  /// @throws StartBlocked     the footprint at `start` is outside the area or in a hole; the text says by how much.
  /// @throws NoPath           no swath can be reached from `start`.
  /// @throws PlanningTimeout  time_budget ran out.
  /// @throws Cancelled        `cancel` was raised; noticed within a few milliseconds.
  CoverageResult plan(const CoverageArea& area, const std::optional<Pose2d>& start, const CoverageProgress& progress,
                      const CancelToken& cancel, const std::function<void()>& checked = {}) const;

 private:
  VehicleParams vehicle_;
  CoverageParams params_;
};

}  // namespace external_command
