// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/motion/region.h"
#include "support/vehicles.h"

namespace external_command {

/// A place to park in, and the task.
struct ParkingWorld {
  VehicleParams vehicle;
  Pose2d start;
  Pose2d goal;
  Region region;
};

/// An upright rectangle around `centre`, turned by `heading`.
Polygon box(const Point2d& centre, double length, double width, double heading = 0.0);

/// A street with parked cars; the goal lies between two of them at the kerb, `slack` [m] longer than the vehicle.
///
///      S ->
///   [car]   G   [car]
///   ================= kerb
ParkingWorld parallelSlot(double slack, const VehicleParams& vehicle = smallCar());

/// A bay between two others, `gap` [m] wider than the vehicle, at an aisle; the goal is backed in.
///
///   ================= wall
///      S ->
///   [c]  G  [c]
///   [a]  ^  [a]
///   [r]     [r]
ParkingWorld bay(double gap, const VehicleParams& vehicle = smallCar());

/// Two yards joined by a gate `gap` [m] wider than the vehicle, inside a drivable border.
///
///   +---------+---------+
///   |  S      |         |
///   |                G  |
///   |         |         |
///   +---------+---------+
ParkingWorld twoYards(double gap, const VehicleParams& vehicle = smallCar());

/// Between two walls of 100 m, `width` [m] apart; to turn round, and go on 20 m behind.
ParkingWorld street(double width, const VehicleParams& vehicle = smallCar());

/// From the left into a corridor that leads up; both are `width` [m] wide.
ParkingWorld corner(double width, const VehicleParams& vehicle = smallCar());

/// The world in another frame.
ParkingWorld moved(const ParkingWorld& world, const Pose2d& frame);

/// Random places of all these kinds with some clutter; the same for the same seed. Start and goal are free by 5 cm, a
/// path need not exist.
std::vector<ParkingWorld> randomWorlds(unsigned seed, std::size_t count);

}  // namespace external_command
