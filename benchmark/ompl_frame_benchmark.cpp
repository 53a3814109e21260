// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "external_command/free_space/free_space_planner.h"
#include "external_command/free_space/planner_log.h"
#include "files.h"
#include "free_space/ompl/first_path.h"
#include "free_space/search/search_box.h"
#include "free_space/search/staged_search.h"
#include "options.h"
#include "parking_case.h"
#include "statistics.h"

namespace external_command {
namespace benchmark {

namespace po = boost::program_options;

namespace {

constexpr const char* kUsage = R"(usage: ompl_frame_benchmark [OPTION...] DIR|FILE...
The own search for the first path of every parking case (*.json), called as it is and as a planner of OMPL. A line for
each case and a summary. Needs no ROS master.
)";

constexpr const char* kDetails =
    R"(Columns: time of the search as it is and in OMPL's frame, medians of calls in turn, their difference [us], and the
second over the first. Cases without a path within the steps are left out.
Exit code: 0; 1 if the two find other paths; 2 if an option is wrong or a file cannot be read.
)";

constexpr double kSame = 1e-6;  ///< paths as long as each other up to this [m]

struct Options {
  int repeat = 100;
  int max_steps = static_cast<int>(kFirstLookSteps);
  std::vector<std::string> inputs;
};

struct Summary {
  std::vector<double> ratios, differences;
  std::size_t cases = 0, unreadable = 0, different = 0;
};

po::options_description describe(Options* options) {
  po::options_description known = noOptions();
  auto add = known.add_options();
  add("repeat", integer("repeat", 1, &options->repeat), "calls of each kind");
  add("max-steps", integer("max-steps", 1, &options->max_steps), "of the search");
  return known;
}

/// One case as the search sees it.
struct Task {
  explicit Task(const ParkingCase& task, double margin = 0.01)
      : index(task.vehicle, margin, task.region, task.start.position(),
              {local(task, task.start), local(task, task.goal)}, [] {}),
        scene{index, task.vehicle.min_turning_radius, {3.0, 1.0, 2.0}},
        query{local(task, task.start), local(task, task.goal)},
        area(searchArea(scene, query)) {}

  static Pose2d local(const ParkingCase& task, const Pose2d& pose) {
    return {pose.x - task.start.x, pose.y - task.start.y, pose.heading};
  }

  FootprintIndex index;
  Scene scene;
  Query query;
  BoundingBox area;
};

/// @return  the path's length, and how long it took [us].
template <class Search>
std::pair<double, double> timed(const Search& search) {
  const auto begin = std::chrono::steady_clock::now();
  const FirstPath path = search();
  const std::chrono::duration<double, std::micro> elapsed = std::chrono::steady_clock::now() - begin;
  const bool is_found = path.outcome == TwoWaySearch::Outcome::kFound;
  return {is_found ? lengthOf(path.arcs) : std::numeric_limits<double>::infinity(), elapsed.count()};
}

void runCase(const ParkingCase& parking_case, const Options& options, Summary* summary) {
  const Task task(parking_case);
  const auto max_steps = static_cast<std::size_t>(options.max_steps);
  const StopCondition stop(CancelToken(), Clock::time_point::max());
  const FirstPathRequest request{"hybrid_astar", max_steps, 1};
  const auto alone = [&] {
    return searchInStages(task.scene, task.query, task.area, max_steps, [&stop] { return stop.isReached(); });
  };
  const auto framed = [&] { return findFirstPath(task.scene, task.query, task.area, request, stop); };
  std::vector<double> alone_times, framed_times;
  for (int i = 0; i < options.repeat; ++i) {  // in turn, so that noise hits both alike
    const auto [length, time] = timed(alone);
    const auto [framed_length, framed_time] = timed(framed);
    if (std::isinf(length) && std::isinf(framed_length)) return;
    if (!(std::abs(length - framed_length) <= kSame)) {
      std::printf("%-28s FAULT: %.6f m as it is, %.6f m in the frame\n", parking_case.name.c_str(), length,
                  framed_length);
      ++summary->different;
      return;
    }
    alone_times.push_back(time);
    framed_times.push_back(framed_time);
  }
  const double search = median(alone_times), frame = median(framed_times);
  summary->ratios.push_back(frame / search);
  summary->differences.push_back(frame - search);
  std::printf("%-28s as it is %9.1f  in the frame %9.1f  more %7.1f  ratio %.3f\n", parking_case.name.c_str(), search,
              frame, frame - search, frame / search);
  std::fflush(stdout);
}

int run(const std::vector<std::string>& words) {
  Options options;
  if (!parseOrHelp(words, describe(&options), {kUsage, kDetails}, &options.inputs)) return 0;
  if (options.inputs.empty()) throw std::invalid_argument("give a folder or files of cases");
  const auto silence = PlannerLog::acquire({});
  Summary summary;
  for (const std::string& file : parkingCaseFiles(options.inputs)) {
    ++summary.cases;
    if (const auto task = tryReading(file, readParkingCase, &summary.unreadable)) runCase(*task, options, &summary);
  }
  std::printf("timed %zu of %zu; in the frame over as it is: median %.3f, largest %.3f; more: median %.1f us\n",
              summary.ratios.size(), summary.cases, median(summary.ratios), largest(summary.ratios),
              median(summary.differences));
  if (summary.unreadable > 0) return 2;
  return summary.different == 0 ? 0 : 1;
}

}  // namespace

}  // namespace benchmark
}  // namespace external_command

int main(int argc, char** argv) {
  return external_command::benchmark::runMain("ompl_frame_benchmark", argc, argv, external_command::benchmark::run);
}
