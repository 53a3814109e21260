// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/core/vehicle.h"

namespace external_command {

/// Vehicles of tests and benchmarks.
inline VehicleParams vehicleWith(double wheelbase, double width, double front_overhang, double rear_overhang,
                                 double min_turning_radius) {
  VehicleParams vehicle;
  vehicle.wheelbase = wheelbase;
  vehicle.width = width;
  vehicle.front_overhang = front_overhang;
  vehicle.rear_overhang = rear_overhang;
  vehicle.min_turning_radius = min_turning_radius;
  return vehicle;
}

inline VehicleParams car() { return vehicleWith(2.8, 1.9, 0.95, 0.95, 5.0); }

/// 4.7 m long, and turns as tightly as the cars of many parking data sets.
inline VehicleParams smallCar() { return vehicleWith(2.8, 1.94, 0.96, 0.93, 3.0); }

inline VehicleParams lorry() { return vehicleWith(5.0, 2.5, 1.4, 2.2, 7.5); }

/// 2.6 m long.
inline VehicleParams sweeper() { return vehicleWith(1.6, 1.3, 0.5, 0.5, 2.5); }

inline VehicleParams tractor() { return vehicleWith(2.5, 2.0, 0.8, 0.9, 5.0); }

}  // namespace external_command
