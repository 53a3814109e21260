// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/coverage/coverage_planner.h"
#include "external_command/motion/collision_checker.h"
#include "support/vehicles.h"

namespace external_command {

inline Polygon box(double x0, double y0, double x1, double y1) {
  return Polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, "box");
}

inline Polygon post(double x, double y) { return box(x - 0.3, y - 0.3, x + 0.3, y + 0.3); }

inline CoverageParams params() {
  CoverageParams params;
  params.swath_width = 1.6;
  params.time_budget = 3600.0;  // a machine may be slow; the plan does not depend on it
  return params;
}

const Pose2d kStart{5.0, 5.0, 0.0};

inline CoverageResult planned(const CoverageArea& area, const CoverageProgress& progress = {}) {
  return CoveragePlanner(sweeper(), params()).plan(area, kStart, progress, {});
}

/// Every pose of the path keeps the whole footprint inside; between neighbours the vehicle moves as a car does, and
/// turns its wheels no faster than it can.
inline testing::AssertionResult isDrivable(const Path& path, const CoverageArea& area) {
  Region::Parts parts;
  parts.drivable = area.outer;
  parts.non_drivable = area.holes;
  const CollisionChecker checker(sweeper(), 0.0, Region(std::move(parts)));
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!checker.isFree(path[i].pose())) return testing::AssertionFailure() << "point " << i << " is not inside";
    if (i == 0) continue;
    const double step = (path[i].pose().position() - path[i - 1].pose().position()).norm();
    if (step > params().spacing + 1e-6) return testing::AssertionFailure() << "jump of " << step << " m at " << i;
    const double turn = std::abs(angleBetween(path[i - 1].heading, path[i].heading));
    if (turn > 1.02 * (path[i].s - path[i - 1].s) / sweeper().min_turning_radius + 1e-3) {
      return testing::AssertionFailure() << "turns by " << turn << " rad at " << i;
    }
    const bool stands = path[i].direction != path[i - 1].direction;
    const double fastest = stands ? INFINITY : steeringSpeed(sweeper(), path[i - 1], path[i]);
    if (0.5 * (path[i - 1].speed + path[i].speed) > 1.01 * fastest) {
      return testing::AssertionFailure() << "is too fast to be steered at " << i;
    }
  }
  return testing::AssertionSuccess();
}

}  // namespace external_command
