// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "coverage_case.h"
#include "coverage_check.h"
#include "coverage_files.h"
#include "external_command/core/driving_time.h"
#include "external_command/core/error.h"
#include "files.h"
#include "made_fields.h"
#include "options.h"
#include "statistics.h"
#include "support/command_path_check.h"

namespace external_command {
namespace benchmark {

namespace po = boost::program_options;

namespace {

constexpr const char* kUsage = R"(usage: benchmark_coverage [OPTION...] [FILE.geojson|DIR ...]
Plans a path that sweeps each field, one line each and a summary. Needs no ROS master. The fields are the polygons of
the files, and of all *.geojson in the folders; without any, fields of its own making: rectangles, L, U, rings, fields
with columns, walls or a narrow neck, and random concave ones with holes, 60 m to 1 km across.
)";

constexpr const char* kDetails =
    R"(In a file: planar coordinates [m], and the properties, each of which may be left out, name, swath_width (4), start
[x, y, theta] of the rear axle, vehicle {wheelbase (2.5), width (2), front_overhang (0.8), rear_overhang (0.9),
min_turning_radius (5) or max_steer}.
Columns: area without holes [ha]; swept share of what the vehicle can reach (the area shrunk by half the larger of
vehicle and swath width, the part at the start, grown by half the swath) and of the whole area [%]; overlap, swept again
over swept; path length [m] and, in brackets, that over swept area / swath width; turns; gear changes; poses at which a
part of the footprint, 1 cm smaller all round, is outside; time that driving takes, changes of gear not counted [s];
time of planning on the wall clock and on the processor [s]. All but the times is measured on the path alone. Exit code:
0; 1 if a field cannot be planned or a path cannot be driven or leaves its field; 2 if an option is wrong or a file
cannot be read or written: one that holds no fields has a line, and the others go on.
)";

constexpr double kLargeField = 12000.0;  // [m^2]

struct Options {
  CoverageParams params;
  int random_fields = 12;
  int seed = 1;
  std::vector<std::string> inputs;
  std::string fields;
  std::string paths;
  std::string drawings;
};

struct Summary {
  std::size_t fields = 0;
  std::size_t faulty = 0;
  std::size_t outside = 0;
  std::size_t unreadable = 0;  ///< files
  std::vector<double> covered, ratios, large_ratios, changes, times;
  double driving = 0.0;  ///< [s]
};

CoverageObjective objectiveOf(const std::string& name) {
  if (name == "shortest") return CoverageObjective::kShortest;
  if (name == "fewest_turns") return CoverageObjective::kFewestTurns;
  throw po::error("--objective is shortest or fewest_turns, not " + name);
}

po::options_description describe(Options* options) {
  CoverageParams& params = options->params;
  params.time_budget = 5.0;
  po::options_description known = noOptions();
  auto add = known.add_options();
  add("random", integer("random", 0, &options->random_fields), "number of random fields");
  add("seed", integer("seed", 0, &options->seed), "of the made fields");
  add("fields", po::value(&options->fields)->value_name("DIR"), "write each made field as DIR/NAME.geojson");
  add("time-budget", number("time-budget", &params.time_budget), "for each field [s]");
  add("laps", integer("laps", -1, &params.headland_laps), "along border and holes; -1: as many as serve the objective");
  add("objective",
      po::value<std::string>()
          ->value_name("NAME")
          ->default_value("shortest")
          ->notifier([&params](const std::string& name) { params.objective = objectiveOf(name); }),
      "shortest or fewest_turns");
  add("gear-cost", number("gear-cost", &params.gear_change_cost), "price of a change of gear, as length [m]");
  add("no-reverse", po::bool_switch()->notifier([&params](bool is_given) { params.reverse_to_turn = !is_given; }),
      "plan for a vehicle that is not to reverse");
  add("turn-speed", number("turn-speed", &params.turn_speed),
      "at which turns can be steered [m/s]; 0: they are arcs and straight pieces");
  add("spacing", number("spacing", &params.spacing), "between two points of the path [m]");
  add("target", number("target", &params.target_coverage),
      "of the reachable area that is to be swept, as share; what is more only where it costs little");
  add("paths", po::value(&options->paths)->value_name("DIR"),
      "write each path as DIR/NAME.json: [[x, y, theta, direction, tool], ...]");
  add("svg", po::value(&options->drawings)->value_name("DIR"),
      "draw each path as DIR/NAME.svg: swept green, left out red");
  return known;
}

/// With a number behind each name that there was before.
void makeNamesUnique(std::vector<CoverageCase>* fields) {
  std::set<std::string> names;
  for (CoverageCase& field : *fields) {
    std::string name = field.name;
    for (int number = 2; !names.insert(name).second; ++number) name = field.name + "_" + std::to_string(number);
    field.name = name;
  }
}

std::vector<CoverageCase> fieldsOf(const Options& options, std::size_t* unreadable) {
  std::vector<CoverageCase> fields;
  std::vector<std::string> skipped;
  const auto read = [&skipped](const std::string& file) { return readCoverageCases(file, &skipped); };
  for (const std::string& file : filesOf(options.inputs, ".geojson")) {
    auto some = tryReading(file, read, unreadable);
    if (some) std::move(some->begin(), some->end(), std::back_inserter(fields));
  }
  for (const std::string& text : skipped) std::fprintf(stderr, "%s\n", text.c_str());
  if (options.inputs.empty()) fields = makeFields(static_cast<unsigned>(options.seed), options.random_fields);
  makeNamesUnique(&fields);
  if (options.inputs.empty() && !options.fields.empty()) {
    for (const CoverageCase& field : fields) writeCoverageCase(field, options.fields + "/" + field.name + ".geojson");
  }
  return fields;
}

void report(const CoverageCheck& check, double driving, double seconds, double cpu_seconds, Summary* summary) {
  std::printf("area %6.2f  swept %6.2f of %6.2f  overlap %.3f  length %7.0f (%.3f)  turns %4zu  gear changes %3zu",
              1e-4 * check.free_area, 100.0 * check.covered_reachable, 100.0 * check.covered_free, check.overlap,
              check.length, check.length_ratio, check.turns, check.gear_changes);
  std::printf("  outside %zu  driving %.0f  time %.3f  cpu %.3f\n", check.outside, driving, seconds, cpu_seconds);
  for (const std::string& fault : check.faults) std::printf("  FAULT: %s\n", fault.c_str());
  summary->faulty += check.faults.empty() ? 0 : 1;
  summary->outside += check.outside > 0 ? 1 : 0;
  summary->covered.push_back(check.covered_reachable);
  summary->ratios.push_back(check.length_ratio);
  if (check.free_area > kLargeField) summary->large_ratios.push_back(check.length_ratio);
  summary->changes.push_back(static_cast<double>(check.gear_changes) / std::max(1.0, static_cast<double>(check.turns)));
  summary->times.push_back(seconds);
  summary->driving += driving;
}

/// With what a controller could not rely on in the path as it is sent.
CoverageCheck checkedAsSent(const CoverageCase& field, const CoverageParams& params, const Path& path) {
  CoverageCheck check = checkCoverage(field, path);
  CommandPathLimits limits;
  limits.max_gap = 1.01 * params.spacing;
  const std::string fault = commandPathFault(path, field.vehicle, std::nullopt, limits);
  if (!fault.empty()) check.faults.push_back(fault);
  return check;
}

void runField(const CoverageCase& field, const Options& options, Summary* summary) {
  std::printf("%-28s ", field.name.c_str());
  CoverageParams params = options.params;
  params.swath_width = field.swath_width;
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu_begin = std::clock();
  try {
    const CoverageResult result = CoveragePlanner(field.vehicle, params).plan(field.area(), field.start, {}, {});
    const double cpu_seconds = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    const auto path = std::make_shared<Path>(result.path);
    limitSpeeds(field.vehicle, path.get());
    const double driving = DrivingTime(field.vehicle, path).left(0.0, 0.0);
    report(checkedAsSent(field, params, *path), driving, elapsed.count(), cpu_seconds, summary);
    if (!options.paths.empty()) writeCoveragePath(*path, options.paths + "/" + field.name + ".json");
    if (!options.drawings.empty()) drawCoverage(field, *path, options.drawings + "/" + field.name + ".svg");
  } catch (const Error& error) {
    std::printf("FAILED %s: %s\n", toString(error.code()), error.what());
  }
  std::fflush(stdout);
}

void print(const Summary& summary) {
  std::printf(
      "planned %zu of %zu; outside %zu, other faults %zu; swept of the reachable: median %.2f %%, least %.2f %%",
      summary.times.size(), summary.fields, summary.outside, summary.faulty - summary.outside,
      100.0 * median(summary.covered), 100.0 * least(summary.covered));
  std::printf("; length ratio: median %.3f, largest %.3f, over 1.2 ha %.3f", median(summary.ratios),
              largest(summary.ratios), largest(summary.large_ratios));
  std::printf(
      "; gear changes a turn: median %.2f, most %.2f; driving %.0f s in all; time: median %.3f s, slowest %.3f s\n",
      median(summary.changes), largest(summary.changes), summary.driving, median(summary.times),
      largest(summary.times));
  if (summary.unreadable > 0) std::printf("files without fields: %zu\n", summary.unreadable);
}

int run(const std::vector<std::string>& words) {
  Options options;
  if (!parseOrHelp(words, describe(&options), {kUsage, kDetails}, &options.inputs)) return 0;
  options.params.validate();
  makeFolders({options.fields, options.paths, options.drawings});
  Summary summary;
  for (const CoverageCase& field : fieldsOf(options, &summary.unreadable)) {
    ++summary.fields;
    runField(field, options, &summary);
  }
  print(summary);
  if (summary.unreadable > 0) return 2;
  return summary.faulty == 0 && summary.times.size() == summary.fields ? 0 : 1;
}

}  // namespace

}  // namespace benchmark
}  // namespace external_command

int main(int argc, char** argv) {
  return external_command::benchmark::runMain("benchmark_coverage", argc, argv, external_command::benchmark::run);
}
