// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "free_space/manoeuvre.h"
#include "free_space/search/distance_map.h"
#include "support/parking_worlds.h"

namespace external_command {

inline const auto kNeverStop = [] { return false; };

/// A place as the searches see it.
struct SearchWorld {
  explicit SearchWorld(const ParkingWorld& world, double margin = 0.0)
      : index(world.vehicle, margin, world.region, {0.0, 0.0}, {world.start, world.goal}, [] {}),
        scene{index, world.vehicle.min_turning_radius, {3.0, 1.0, 2.0}},
        query{world.start, world.goal, 0},
        area{world.start.position().cwiseMin(world.goal.position()) - Point2d::Constant(kRoom),
             world.start.position().cwiseMax(world.goal.position()) + Point2d::Constant(kRoom)},
        to_start(index, area, world.start),
        to_goal(index, area, world.goal) {}

  static constexpr double kRoom = 20.0;  ///< around start and goal [m]

  FootprintIndex index;
  Scene scene;
  Query query;
  BoundingBox area;
  DistanceMap to_start, to_goal;
};

}  // namespace external_command
