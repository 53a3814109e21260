// SPDX-License-Identifier: Apache-2.0
//
// map_findings [--max-link-gap M] [--vehicle KEY=VALUE]... [--ignore KIND]... [--svg FILE] MAP
// map_findings --kinds
// What is wrong with a map, as JSON on stdout; scripts/check_map is the command for people. Exit status: 0, also where
// something is wrong with the map; 2 with a text on stderr where the map, or the command line, cannot be read.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>

#include "external_command/core/error.h"
#include "external_command/core/nearest_words.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/map/map_reader.h"
#include "map_check.h"
#include "map_drawing.h"
#include "report_json.h"

namespace external_command {
namespace {

struct Options {
  MapCheckParams params;
  std::vector<MapFault> ignored;
  std::string svg;
  std::string map;
  bool shows_kinds = false;
};

double numberOf(const std::string& option, const std::string& words) {
  char* end = nullptr;
  const double number = std::strtod(words.c_str(), &end);
  if (words.empty() || *end != '\0') throw InvalidParameter(text(option, ": ", quoted(words), " is no number"));
  return number;
}

void setVehicle(const std::string& words, VehicleParams* vehicle) {
  const std::map<std::string, double*> fields = {{"wheelbase", &vehicle->wheelbase},
                                                 {"width", &vehicle->width},
                                                 {"front_overhang", &vehicle->front_overhang},
                                                 {"rear_overhang", &vehicle->rear_overhang},
                                                 {"min_turning_radius", &vehicle->min_turning_radius},
                                                 {"max_speed", &vehicle->max_speed},
                                                 {"max_reverse_speed", &vehicle->max_reverse_speed},
                                                 {"max_acceleration", &vehicle->max_acceleration},
                                                 {"max_deceleration", &vehicle->max_deceleration},
                                                 {"max_lateral_acceleration", &vehicle->max_lateral_acceleration},
                                                 {"max_steering_rate", &vehicle->max_steering_rate}};
  const std::string key = words.substr(0, words.find('='));
  const auto field = fields.find(key);
  if (field == fields.end() || key.size() == words.size()) {
    NearestWords nearest(key);
    for (const auto& known : fields) nearest.offer(known.first);
    throw InvalidParameter(text("--vehicle: there is no ", quoted(key), " of a vehicle", nearest.question()));
  }
  *field->second = numberOf("--vehicle: " + key, words.substr(key.size() + 1));
}

MapFault kindNamed(const std::string& name) {
  NearestWords nearest(name);
  for (const MapFaultKind& kind : mapFaultKinds()) {
    if (kind.name == name) return kind.fault;
    nearest.offer(kind.name);
  }
  throw InvalidParameter(text("--ignore: there is no kind ", quoted(name), nearest.question()));
}

Options readOptions(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&] {
      if (i + 1 == words.size()) throw InvalidParameter(text(word, " needs a value"));
      return words[++i];
    };
    if (word == "--kinds") {
      options.shows_kinds = true;
    } else if (word == "--max-link-gap") {
      options.params.max_link_gap = numberOf(word, value());
    } else if (word == "--vehicle") {
      setVehicle(value(), &options.params.vehicle);
    } else if (word == "--ignore") {
      options.ignored.push_back(kindNamed(value()));
    } else if (word == "--svg") {
      options.svg = value();
    } else if (options.map.empty()) {
      options.map = word;
    } else {
      throw InvalidParameter(text("only one map is read at a time; ", quoted(word), " is too much"));
    }
  }
  options.params.vehicle.validate();
  MapParams map_params;
  map_params.max_link_gap = options.params.max_link_gap;
  map_params.validate();
  if (options.map.empty() && !options.shows_kinds) throw InvalidParameter("a map file is needed");
  return options;
}

void run(const Options& options) {
  if (options.shows_kinds) return writeKinds(std::cout);
  MapReport report;
  try {
    report = checkMap(readMapData(options.map), options.params);
  } catch (const MapError& error) {
    const std::string words = error.what();
    throw MapError(words.find(options.map) == std::string::npos ? text(options.map, ": ", words) : words);
  }
  const auto is_ignored = [&](const MapFinding& finding) {
    return std::find(options.ignored.begin(), options.ignored.end(), finding.fault) != options.ignored.end();
  };
  report.findings.erase(std::remove_if(report.findings.begin(), report.findings.end(), is_ignored),
                        report.findings.end());
  if (!options.svg.empty()) drawMap(report, options.svg);
  writeReport(report, options.map, std::cout);
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  try {
    external_command::run(external_command::readOptions({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return std::cout.flush() ? EXIT_SUCCESS : 2;
}
