// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/free_space/free_space_planner.h"
#include "support/parking_worlds.h"

namespace external_command {

constexpr double kMarginSlack = 2e-3;  ///< of the margin, that two checks may miss between them [m]

/// A budget of work, so that results do not depend on the clock.
inline FreeSpaceParams quickParams(double margin = 0.05) {
  FreeSpaceParams params;
  params.margin = margin;
  params.time_budget = 600.0;  // the iterations bound the work, whatever else the machine does
  params.improve_budget = 300.0;
  params.improve_iterations = 1000;
  return params;
}

inline FreeSpacePlan planned(const ParkingWorld& world, const FreeSpaceParams& params) {
  return FreeSpacePlanner(world.vehicle, params).plan(world.start, {world.goal}, world.region, {});
}

}  // namespace external_command
