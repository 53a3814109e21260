// SPDX-License-Identifier: Apache-2.0
#include "json_fields.h"

#include <cmath>
#include <stdexcept>

namespace external_command {
namespace benchmark {

std::vector<double> numbersOf(const JsonTree& list, std::size_t wanted, const std::string& what) {
  std::vector<double> numbers;
  for (const auto& child : list) {
    const auto number = child.second.get_value_optional<double>();
    if (!number) throw std::runtime_error(what + " holds something that is no number");
    numbers.push_back(*number);
  }
  if (numbers.size() != wanted) throw std::runtime_error(what + " must be " + std::to_string(wanted) + " numbers");
  return numbers;
}

VehicleParams vehicleOf(const JsonTree& tree, const std::optional<VehicleParams>& defaults) {
  VehicleParams vehicle = defaults.value_or(VehicleParams());
  const auto read = [&](const char* key, double* value) {
    if (!defaults || tree.count(key) > 0) *value = tree.get<double>(key);
  };
  read("wheelbase", &vehicle.wheelbase);
  read("width", &vehicle.width);
  read("front_overhang", &vehicle.front_overhang);
  read("rear_overhang", &vehicle.rear_overhang);
  if (tree.count("max_steer") > 0 && tree.count("min_turning_radius") == 0) {
    vehicle.min_turning_radius = vehicle.wheelbase / std::tan(tree.get<double>("max_steer"));
  } else {
    read("min_turning_radius", &vehicle.min_turning_radius);
  }
  return vehicle;
}

}  // namespace benchmark
}  // namespace external_command
