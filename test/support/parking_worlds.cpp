// SPDX-License-Identifier: Apache-2.0
#include "support/parking_worlds.h"

#include <cmath>
#include <random>

#include "support/reference_clearance.h"

namespace external_command {

namespace {

constexpr double kFree = 0.05;  ///< start and goal of random worlds keep this clearance [m]

/// Rear-axle pose of a vehicle whose footprint has its middle at `middle`.
Pose2d parkedAt(const Point2d& middle, double heading, const VehicleParams& vehicle) {
  const double ahead = vehicle.length() / 2.0 - vehicle.rear_overhang;
  const Point2d axle = middle - ahead * unitVector(heading);
  return {axle.x(), axle.y(), heading};
}

Polygon moved(const Polygon& polygon, const Pose2d& frame) {
  std::vector<Point2d> points;
  for (const Point2d& point : polygon.points()) {
    points.push_back(compose(frame, {point.x(), point.y(), 0.0}).position());
  }
  return Polygon(points, "moved");
}

ParkingWorld worldOf(const VehicleParams& vehicle, const Pose2d& start, const Pose2d& goal, Region::Parts parts) {
  return {vehicle, start, goal, Region(std::move(parts))};
}

}  // namespace

Polygon box(const Point2d& centre, double length, double width, double heading) {
  std::vector<Point2d> points;
  for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    points.push_back(compose({centre.x(), centre.y(), heading}, {u * length, v * width, 0.0}).position());
  }
  return Polygon(points, "box");
}

ParkingWorld parallelSlot(double slack, const VehicleParams& vehicle) {
  const double length = vehicle.length(), width = vehicle.width;
  Region::Parts parts;
  parts.non_drivable.push_back(box({0.0, -0.5}, 10.0 * length, 1.0));
  const double y = 0.2 + width / 2.0;
  for (const double side : {-1.0, 1.0}) {
    parts.non_drivable.push_back(box({side * (length + slack / 2.0), y}, length, width));
  }
  return worldOf(vehicle, parkedAt({-length, y + 1.3 * width}, 0.0, vehicle), parkedAt({0.0, y}, 0.0, vehicle),
                 std::move(parts));
}

ParkingWorld bay(double gap, const VehicleParams& vehicle) {
  const double length = vehicle.length(), width = vehicle.width;
  const double aisle = width + 1.2 * vehicle.min_turning_radius;
  Region::Parts parts;
  for (const double side : {-1.0, 1.0}) {
    parts.non_drivable.push_back(box({side * (width + gap / 2.0), length / 2.0}, width, length));
  }
  parts.non_drivable.push_back(box({0.0, -0.8}, 10.0 * length, 1.0));
  parts.non_drivable.push_back(box({0.0, length + aisle + 0.5}, 10.0 * length, 1.0));
  return worldOf(vehicle, parkedAt({-1.5 * length, length + aisle / 2.0}, 0.0, vehicle),
                 parkedAt({0.0, length / 2.0}, M_PI / 2.0, vehicle), std::move(parts));
}

ParkingWorld twoYards(double gap, const VehicleParams& vehicle) {
  const double side = vehicle.length() + 2.5 * vehicle.min_turning_radius;
  const double gate = vehicle.width + gap;
  Region::Parts parts;
  parts.drivable = box({side, side / 2.0}, 2.0 * side, side);
  const double wall = (side - gate) / 2.0;
  parts.non_drivable.push_back(box({side, wall / 2.0}, 0.3, wall));
  parts.non_drivable.push_back(box({side, side - wall / 2.0}, 0.3, wall));
  return worldOf(vehicle, parkedAt({0.4 * side, 0.75 * side}, 1.0, vehicle),
                 parkedAt({1.6 * side, 0.3 * side}, -0.5, vehicle), std::move(parts));
}

ParkingWorld street(double width, const VehicleParams& vehicle) {
  Region::Parts parts;
  for (const double side : {-1.0, 1.0})
    parts.non_drivable.push_back(box({0.0, side * (width + 1.0) / 2.0}, 100.0, 1.0));
  return worldOf(vehicle, {-10.0, 0.0, 0.0}, {10.0, 0.0, M_PI}, std::move(parts));
}

ParkingWorld corner(double width, const VehicleParams& vehicle) {
  Region::Parts parts;
  parts.drivable = Polygon({{-40.0, 0.0}, {width, 0.0}, {width, 40.0}, {0.0, 40.0}, {0.0, width}, {-40.0, width}}, "");
  return worldOf(vehicle, {-15.0, width / 2.0, 0.0}, {width / 2.0, 15.0, M_PI_2}, std::move(parts));
}

ParkingWorld moved(const ParkingWorld& world, const Pose2d& frame) {
  Region::Parts parts;
  if (world.region.drivable()) parts.drivable = moved(*world.region.drivable(), frame);
  for (const Polygon& polygon : world.region.nonDrivable()) parts.non_drivable.push_back(moved(polygon, frame));
  parts.grid = world.region.grid();
  if (parts.grid) parts.grid->origin = compose(frame, parts.grid->origin);
  return worldOf(world.vehicle, compose(frame, world.start), compose(frame, world.goal), std::move(parts));
}

std::vector<ParkingWorld> randomWorlds(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;  // the same numbers everywhere
  };
  std::vector<ParkingWorld> worlds;
  while (worlds.size() < count) {
    VehicleParams vehicle = smallCar();
    vehicle.wheelbase = uniform(2.2, 3.2);
    vehicle.width = uniform(1.6, 2.1);
    vehicle.min_turning_radius = uniform(3.0, 5.5);
    const double kind = uniform(0.0, 3.0);
    ParkingWorld world = kind < 1.0   ? parallelSlot(uniform(0.7, 3.0), vehicle)
                         : kind < 2.0 ? bay(uniform(0.4, 1.2), vehicle)
                                      : twoYards(uniform(0.5, 2.0), vehicle);
    Region::Parts parts;
    parts.drivable = world.region.drivable();
    parts.non_drivable = world.region.nonDrivable();
    for (int i = 0; i < 3; ++i) {
      parts.non_drivable.push_back(
          box({uniform(-10.0, 20.0), uniform(-10.0, 20.0)}, uniform(0.3, 2.0), uniform(0.3, 2.0), uniform(0.0, M_PI)));
    }
    world = worldOf(vehicle, world.start, world.goal, std::move(parts));
    const bool is_free = referenceClearance(vehicle, world.start, world.region) > kFree &&
                         referenceClearance(vehicle, world.goal, world.region) > kFree;
    if (is_free) worlds.push_back(moved(world, {uniform(-1e4, 1e4), uniform(-1e4, 1e4), uniform(-M_PI, M_PI)}));
  }
  return worlds;
}

}  // namespace external_command
