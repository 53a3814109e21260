// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "free_space/manoeuvre.h"
#include "support/parking_worlds.h"

namespace external_command {

inline const auto kNeverStop = [] { return false; };

/// A place as the searches see it, without a margin.
struct SearchWorld {
  explicit SearchWorld(const ParkingWorld& world)
      : index(world.vehicle, 0.0, world.region, {0.0, 0.0}, {world.start, world.goal}, [] {}),
        scene{index, world.vehicle.min_turning_radius, {3.0, 1.0, 2.0}},
        query{world.start, world.goal, 0} {
    constexpr double kRoom = 20.0;  // [m]
    const Point2d room = Point2d::Constant(kRoom);
    area = {world.start.position().cwiseMin(world.goal.position()) - room,
            world.start.position().cwiseMax(world.goal.position()) + room};
  }

  FootprintIndex index;
  Scene scene;
  Query query;
  BoundingBox area;
};

}  // namespace external_command
