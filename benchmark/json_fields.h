// SPDX-License-Identifier: Apache-2.0
#pragma once

#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // Boost's own JSON parser still uses them
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/vehicle.h"

namespace external_command {
namespace benchmark {

using JsonTree = boost::property_tree::ptree;

/// The numbers of a list.
/// @throws std::exception  one is no number, or there are not `wanted` of them: the text begins with `what`.
std::vector<double> numbersOf(const JsonTree& list, std::size_t wanted, const std::string& what);

/// `wheelbase`, `width`, `front_overhang`, `rear_overhang` and `min_turning_radius` or `max_steer` [m, rad].
/// @param defaults  for those that are not there; not given: they must be.
/// @throws std::exception  one is missing, or no number.
VehicleParams vehicleOf(const JsonTree& tree, const std::optional<VehicleParams>& defaults);

}  // namespace benchmark
}  // namespace external_command
