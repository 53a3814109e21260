// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <ctime>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.h"
#include "external_command/core/error.h"
#include "external_command/free_space/free_space_planner.h"
#include "external_command/free_space/planner_log.h"
#include "files.h"
#include "parking_case.h"
#include "path_files.h"
#include "statistics.h"
#include "support/command_path_check.h"

namespace external_command {
namespace benchmark {

namespace {

constexpr const char* kUsage = R"(usage: benchmark_free_space [OPTION...] DIR|FILE...
Plans every parking case (*.json), one line each and a summary. Needs no ROS master.
  --time-budget S   for each case, improvement included (1)
  --improve S       of it, for improving the first path (all that is left)
  --planner NAME    portfolio, hybrid_astar, or OMPL's rrtconnect, rrtstar, kpiece (portfolio)
  --seed N          of the random numbers (1)
  --threads N       that improve the path side by side (1)
  --margin M        distance kept to all obstacles [m] (0.01)
  --continuous      curvature continuous between gear changes
  --paths DIR       write each path as DIR/CASE.json: [[x, y, theta, direction], ...]
  --svg DIR         draw each path as DIR/CASE.svg
Columns: time and cost of the first valid path, cost of the final one (in brackets: of best_known.json beside the
cases), its length [m], gear changes and clearance [m], and the time that the case took on the wall clock and on the
processor [s]. Cost is length plus 3 m per gear change. A path that a controller could not rely on has a line more.
Exit code: 0; 1 if there is such a path; 2 if an option is wrong or a file cannot be read or written.
)";

struct Options {
  FreeSpaceParams params;
  std::vector<std::string> inputs;
  std::string paths;
  std::string drawings;
};

struct Summary {
  std::size_t cases = 0;
  std::size_t faulty = 0;
  std::vector<double> first_times, first_ratios, ratios;
};

Options parse(CommandLine line) {
  Options options;
  FreeSpaceParams& params = options.params;
  params.margin = 0.01;
  params.improve_iterations = 0;
  double improve = -1.0;
  options.inputs = line.parse({{"--time-budget", [&] { params.time_budget = line.number(); }},
                               {"--improve", [&] { improve = line.number(); }},
                               {"--planner", [&] { params.planner = line.value(); }},
                               {"--seed", [&] { params.seed = static_cast<unsigned>(line.integer(0)); }},
                               {"--threads", [&] { params.threads = static_cast<unsigned>(line.integer(0)); }},
                               {"--margin", [&] { params.margin = line.number(); }},
                               {"--continuous", [&] { params.continuous_curvature = true; }},
                               {"--paths", [&] { options.paths = line.value(); }},
                               {"--svg", [&] { options.drawings = line.value(); }}});
  params.improve_budget = improve < 0.0 ? params.time_budget : improve;
  if (options.inputs.empty()) throw std::invalid_argument("give a folder or files of cases");
  return options;
}

void report(const FreeSpacePlan& result, double best_known, double cpu_seconds, Summary* summary) {
  summary->first_times.push_back(result.first_path_time);
  std::printf("first %7.2f ms %7.3f", 1e3 * result.first_path_time, result.first_path_cost);
  if (best_known > 0.0) {
    summary->first_ratios.push_back(result.first_path_cost / best_known);
    summary->ratios.push_back(result.cost / best_known);
    std::printf(" (%.3f)", summary->first_ratios.back());
  }
  std::printf("  final %7.3f", result.cost);
  if (best_known > 0.0) std::printf(" (%.3f)", summary->ratios.back());
  std::printf("  length %7.3f  gear changes %2u  clearance %.3f  time %.3f  cpu %.3f\n", result.length,
              result.gear_changes, result.min_clearance, result.planning_time, cpu_seconds);
}

/// As it would be sent: its caps of speed made limits.
void check(const ParkingCase& task, Path path, Summary* summary) {
  limitSpeeds(task.vehicle, &path);
  const std::string fault = commandPathFault(path, task.vehicle, task.start);
  if (fault.empty()) return;
  ++summary->faulty;
  std::printf("  FAULT: %s\n", fault.c_str());
}

void runCase(const std::string& file, const Options& options, Summary* summary) {
  const ParkingCase task = readParkingCase(file);
  const std::map<std::string, double> best_known = bestKnownCosts(file);
  const auto known = best_known.find(task.name);
  std::printf("%-28s ", task.name.c_str());
  const std::clock_t begin = std::clock();
  try {
    const FreeSpacePlanner planner(task.vehicle, options.params);
    const FreeSpacePlan result = planner.plan(task.start, {task.goal}, task.region, {});
    const double cpu_seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    report(result, known == best_known.end() ? 0.0 : known->second, cpu_seconds, summary);
    check(task, result.path, summary);
    if (!options.paths.empty()) writePath(task, result.path, options.paths + "/" + task.name + ".json");
    if (!options.drawings.empty()) writeDrawing(task, result.path, options.drawings + "/" + task.name + ".svg");
  } catch (const Error& error) {
    std::printf("FAILED %s: %s\n", toString(error.code()), error.what());
  }
  std::fflush(stdout);
}

void print(const Summary& summary) {
  std::printf("solved %zu of %zu; first path: median %.2f ms, slowest %.2f ms", summary.first_times.size(),
              summary.cases, 1e3 * median(summary.first_times), 1e3 * largest(summary.first_times));
  if (!summary.ratios.empty()) {
    std::printf("; cost over best known, median (largest): first %.3f (%.3f), final %.3f (%.3f)",
                median(summary.first_ratios), largest(summary.first_ratios), median(summary.ratios),
                largest(summary.ratios));
  }
  std::printf("; faulty paths: %zu\n", summary.faulty);
}

int run(const CommandLine& line) {
  if (line.asksForHelp()) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  const Options options = parse(line);
  options.params.validate();
  makeFolders({options.paths, options.drawings});
  setPlannerLog({});
  Summary summary;
  for (const std::string& file : parkingCaseFiles(options.inputs)) {
    ++summary.cases;
    runCase(file, options, &summary);
  }
  print(summary);
  return summary.faulty == 0 ? 0 : 1;
}

}  // namespace

}  // namespace benchmark
}  // namespace external_command

int main(int argc, char** argv) {
  try {
    return external_command::benchmark::run(external_command::benchmark::CommandLine({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_free_space: %s\nSee benchmark_free_space --help.\n", error.what());
    return 2;
  }
}
