// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "external_command/core/error.h"
#include "external_command/free_space/free_space_planner.h"
#include "external_command/free_space/planner_log.h"
#include "files.h"
#include "made_cases.h"
#include "options.h"
#include "parking_case.h"
#include "path_files.h"
#include "statistics.h"
#include "support/command_path_check.h"

namespace external_command {
namespace benchmark {

namespace po = boost::program_options;

namespace {

constexpr const char* kUsage = R"(usage: benchmark_free_space [OPTION...] DIR|FILE...
       benchmark_free_space --made SEED [OPTION...]
Plans every parking case (*.json), one line each and a summary. Needs no ROS master.
)";

constexpr const char* kDetails =
    R"(Columns: time and plain cost of the first valid path, plain cost of the final one (in brackets: of best_known.json
beside the cases), its cost with all prices, its length, that in reverse and that near obstacles [m], gear changes,
turns of the wheels between them (1: from straight on to full lock), how long a vehicle at manoeuvre speed waits for
these [s], clearance [m], and the time that the case took on the wall clock and on the processor [s]. The plain cost,
that of best_known.json, is length plus 3 m per gear change. A path that a controller could not rely on has a line more.
A file that is no case has a line, and the others go on.
Exit code: 0; 1 if there is such a path; 2 if an option is wrong or a file cannot be read or written.
)";

struct Options {
  FreeSpaceParams params;
  std::vector<std::string> inputs;
  int made = -1;  // seed of made cases; -1: none
  int seed = 1;
  int threads = 1;
  double improve = -1.0;  // [s]; below 0: all that is left of the time budget
  std::string only;
  std::string cases;
  std::string paths;
  std::string drawings;
};

struct Summary {
  std::size_t cases = 0;
  std::size_t faulty = 0;
  std::size_t unreadable = 0;                                    // files
  double length = 0.0, reverse_length = 0.0, near_length = 0.0;  // of all paths [m]
  std::vector<double> wheel_turns, waits;
  std::vector<double> first_times, first_ratios, ratios, cpu_times;
};

po::options_description describe(Options* options) {
  FreeSpaceParams& params = options->params;
  params.margin = 0.01;
  po::options_description known = noOptions();
  auto add = known.add_options();
  add("made", integer("made", -1, &options->made)->value_name("SEED"),
      "hard cases made with these random numbers (slaloms, car parks, docks, alleys, mazes, long roads); -1: none");
  add("only", po::value(&options->only)->value_name("TEXT"), "those cases whose name contains TEXT");
  add("cases", po::value(&options->cases)->value_name("DIR"), "write each case as DIR/CASE.json");
  add("time-budget", number("time-budget", &params.time_budget), "for each case, improvement included [s]");
  add("improve", number("improve", &options->improve),
      "of it, for improving the first path [s]; below 0: all that is left");
  add("planner", po::value(&params.planner)->value_name("NAME")->default_value(params.planner),
      "portfolio, hybrid_astar, or OMPL's rrtconnect, rrtstar, kpiece");
  add("seed", integer("seed", 0, &options->seed), "of the random numbers");
  add("threads", integer("threads", 0, &options->threads), "that improve the path side by side");
  add("margin", number("margin", &params.margin), "distance kept to all obstacles [m]");
  add("reverse-factor", number("reverse-factor", &params.reverse_factor),
      "price of a metre in reverse, as length forward [m]");
  add("gear-change-cost", number("gear-change-cost", &params.gear_change_cost),
      "price of a gear change, as length [m]");
  add("steering-cost", number("steering-cost", &params.steering_cost),
      "price of turning the wheels from straight on to full lock, as length [m]");
  add("closeness-cost", number("closeness-cost", &params.closeness_cost),
      "price of a metre beside an obstacle at the margin, as length [m]");
  add("closeness-distance", number("closeness-distance", &params.closeness_distance),
      "beyond the margin, from where on that is nothing [m]");
  add("jumps", po::bool_switch()->notifier([&params](bool is_given) { params.continuous_curvature = !is_given; }),
      "curvature that jumps from arc to arc, as the search leaves it");
  add("paths", po::value(&options->paths)->value_name("DIR"),
      "write each path as DIR/CASE.json: [[x, y, theta, direction], ...]");
  add("svg", po::value(&options->drawings)->value_name("DIR"), "draw each path as DIR/CASE.svg");
  return known;
}

/// What follows from the options that were given.
void complete(Options* options) {
  FreeSpaceParams& params = options->params;
  params.improve_iterations = 0;
  params.seed = static_cast<unsigned>(options->seed);
  params.threads = static_cast<unsigned>(options->threads);
  params.improve_budget = options->improve < 0.0 ? params.time_budget : options->improve;
  if (options->inputs.empty() && options->made < 0) throw std::invalid_argument("give a folder or files of cases");
}

/// What best_known.json counts, whatever the prices of the search are.
double plainCost(double length, unsigned gear_changes) { return length + 3.0 * gear_changes; }

/// How much longer than at `speed` the path takes since the steering cannot keep up, but for gear changes [s].
double waitForSteering(const Path& path, const VehicleParams& vehicle, double speed) {
  double wait = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].direction != path[i - 1].direction) continue;
    const double turned =
        std::abs(std::atan(vehicle.wheelbase * path[i].kappa) - std::atan(vehicle.wheelbase * path[i - 1].kappa));
    wait += std::max(0.0, turned / vehicle.max_steering_rate - (path[i].s - path[i - 1].s) / speed);
  }
  return wait;
}

void report(const FreeSpacePlan& result, double wait, double best_known, double cpu_seconds, Summary* summary) {
  const double first = plainCost(result.first_path_length, result.first_path_gear_changes);
  const double final = plainCost(result.length, result.gear_changes);
  summary->first_times.push_back(result.first_path_time);
  summary->length += result.length;
  summary->reverse_length += result.reverse_length;
  summary->near_length += result.near_length;
  summary->wheel_turns.push_back(result.wheel_turns);
  summary->waits.push_back(wait);
  std::printf("first %7.2f ms %7.3f", 1e3 * result.first_path_time, first);
  if (best_known > 0.0) {
    summary->first_ratios.push_back(first / best_known);
    summary->ratios.push_back(final / best_known);
    std::printf(" (%.3f)", summary->first_ratios.back());
  }
  std::printf("  final %7.3f", final);
  if (best_known > 0.0) std::printf(" (%.3f)", summary->ratios.back());
  std::printf(
      "  cost %7.3f  length %7.3f  reverse %7.3f  near %7.3f  gear changes %2u  wheel turns %4.1f  wait %4.1f  "
      "clearance %.3f  time %.3f  cpu %.3f\n",
      result.cost, result.length, result.reverse_length, result.near_length, result.gear_changes, result.wheel_turns,
      wait, result.min_clearance, result.planning_time, cpu_seconds);
}

/// As it would be sent: its caps of speed made limits.
void check(const ParkingCase& task, Path path, Summary* summary) {
  limitSpeeds(task.vehicle, &path);
  const std::string fault = commandPathFault(path, task.vehicle, task.start);
  if (fault.empty()) return;
  ++summary->faulty;
  std::printf("  FAULT: %s\n", fault.c_str());
}

void runCase(const ParkingCase& task, const std::map<std::string, double>& best_known, const Options& options,
             Summary* summary) {
  if (task.name.find(options.only) == std::string::npos) return;
  ++summary->cases;
  if (!options.cases.empty()) writeCase(task, options.cases + "/" + task.name + ".json");
  const auto known = best_known.find(task.name);
  std::printf("%-28s ", task.name.c_str());
  const std::clock_t begin = std::clock();
  const auto cpuSeconds = [begin] { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
  try {
    const FreeSpacePlanner planner(task.vehicle, options.params);
    const FreeSpacePlan result = planner.plan(task.start, {task.goal}, task.region, {});
    const double cpu_seconds = cpuSeconds();
    const double wait = waitForSteering(result.path, task.vehicle, options.params.manoeuvre_speed);
    report(result, wait, known == best_known.end() ? 0.0 : known->second, cpu_seconds, summary);
    check(task, result.path, summary);
    if (!options.paths.empty()) writePath(task, result.path, options.paths + "/" + task.name + ".json");
    if (!options.drawings.empty()) writeDrawing(task, result.path, options.drawings + "/" + task.name + ".svg");
  } catch (const Error& error) {
    std::printf("FAILED cpu %.3f %s: %s\n", cpuSeconds(), toString(error.code()), error.what());
  }
  summary->cpu_times.push_back(cpuSeconds());
  std::fflush(stdout);
}

void runFile(const std::string& file, const Options& options, Summary* summary) {
  const auto task = tryReading(file, readParkingCase, &summary->unreadable);
  if (!task) {
    ++summary->cases;
    return;
  }
  const auto best_known = tryReading(file, bestKnownCosts, &summary->unreadable);
  runCase(*task, best_known.value_or(std::map<std::string, double>()), options, summary);
}

void print(const Summary& summary) {
  std::printf("solved %zu of %zu; first path: median %.2f ms, slowest %.2f ms", summary.first_times.size(),
              summary.cases, 1e3 * median(summary.first_times), 1e3 * largest(summary.first_times));
  if (!summary.ratios.empty()) {
    std::printf("; plain cost over best known, median (largest): first %.3f (%.3f), final %.3f (%.3f)",
                median(summary.first_ratios), largest(summary.first_ratios), median(summary.ratios),
                largest(summary.ratios));
  }
  std::printf(
      "; in reverse %.1f %% of the way, near obstacles %.1f %%; wheel turns median %.1f, wait for them mean %.1f s; "
      "cpu median %.3f s, most %.3f s; faulty paths: %zu\n",
      100.0 * summary.reverse_length / std::max(summary.length, 1e-9),
      100.0 * summary.near_length / std::max(summary.length, 1e-9), median(summary.wheel_turns),
      std::accumulate(summary.waits.begin(), summary.waits.end(), 0.0) / std::max<double>(summary.waits.size(), 1),
      median(summary.cpu_times), largest(summary.cpu_times), summary.faulty);
  if (summary.unreadable > 0) std::printf("files that are no cases: %zu\n", summary.unreadable);
}

int run(const std::vector<std::string>& words) {
  Options options;
  if (!parseOrHelp(words, describe(&options), {kUsage, kDetails}, &options.inputs)) return 0;
  complete(&options);
  options.params.validate();
  makeFolders({options.cases, options.paths, options.drawings});
  const auto silence = PlannerLog::acquire({});
  Summary summary;
  for (const std::string& file : parkingCaseFiles(options.inputs)) runFile(file, options, &summary);
  if (options.made >= 0) {
    for (const ParkingCase& task : makeParkingCases(static_cast<unsigned>(options.made))) {
      runCase(task, {}, options, &summary);
    }
  }
  print(summary);
  if (summary.unreadable > 0) return 2;
  return summary.faulty == 0 ? 0 : 1;
}

}  // namespace

}  // namespace benchmark
}  // namespace external_command

int main(int argc, char** argv) {
  return external_command::benchmark::runMain("benchmark_free_space", argc, argv, external_command::benchmark::run);
}
