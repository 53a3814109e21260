// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "external_command/map/hd_map.h"

namespace external_command {
namespace benchmark {

/// One JSON object of a map.
using MeasureMap = std::function<std::string(std::shared_ptr<const HdMap> map, const std::string& name)>;

/// Measures each map of the command line, `[--city CROSSINGS_PER_SIDE]... FILE...`, and prints one JSON array.
/// @return the exit code
int measureMaps(int argc, char** argv, const MeasureMap& measure);

}  // namespace benchmark
}  // namespace external_command
