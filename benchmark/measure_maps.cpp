// SPDX-License-Identifier: Apache-2.0
#include "measure_maps.h"

#include <exception>
#include <iostream>

#include "external_command/map/map_reader.h"
#include "grid_city.h"

namespace external_command {
namespace benchmark {

int measureMaps(int argc, char** argv, const MeasureMap& measure) {
  if (argc < 2) {
    std::cerr << "usage: " << argv[0] << " [--city CROSSINGS_PER_SIDE]... FILE...\n";
    return 2;
  }
  try {
    std::string separator = "[";
    for (int i = 1; i < argc; ++i) {
      const std::string argument = argv[i];
      const bool is_city = argument == "--city" && i + 1 < argc;
      const std::string name = is_city ? std::string("city ") + argv[++i] : argument;
      const auto map = is_city ? std::make_shared<const HdMap>(gridCity(std::stoi(argv[i])), Point2d::Zero())
                               : readMap(argument, {});
      std::cout << separator << measure(map, name) << std::flush;
      separator = ",\n ";
    }
    std::cout << "]\n";
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}

}  // namespace benchmark
}  // namespace external_command
