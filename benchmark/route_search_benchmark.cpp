// SPDX-License-Identifier: Apache-2.0
//
// route_search_benchmark [--city CROSSINGS_PER_SIDE]... FILE...
// Measures, for each map file and made-up city, routes between random places of its lanes, lane list included: by the
// search with its index, and by the same without it (Dijkstra). Prints one JSON array; fails where their costs differ.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "../src/routing/route_builder.h"
#include "../src/routing/route_search.h"
#include "measure_maps.h"
#include "statistics.h"

namespace external_command {
namespace {

constexpr double kSameCost = 0.001;  // [m]
constexpr double kNoRoute = -1.0;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Resident memory of this process [MB].
double residentMegabytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  in >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

class Measurement {
 public:
  explicit Measurement(std::shared_ptr<const HdMap> map) : map_(std::move(map)) {
    for (LaneIndex i = 0; i < map_->lanes().size(); ++i) {
      if (map_->lane(i).isDrivable()) lanes_.push_back(i);
    }
  }

  std::string run(const std::string& name) {
    const double begin = now();
    const LaneGraph graph(*map_, params_);
    const double graph_built = now();
    const double before = residentMegabytes();
    const RouteIndex index(graph, params_);
    const double index_built = now();
    const double after = residentMegabytes();
    const int queries = std::clamp(static_cast<int>(200000000 / lanes_.size()), 200, 5000);
    std::vector<RouteQuery> asked;
    for (int i = 0; i < queries; ++i) asked.push_back({{anyPlace()}, {}, {anyPlace()}, {}});
    const Answers answers = answer(graph, &index, asked), plain = answer(graph, nullptr, asked);
    const int differing = differences(answers.costs, plain.costs);
    if (differing > 0) {
      throw std::runtime_error(name + ": " + std::to_string(differing) + " of " + std::to_string(queries) +
                               " routes cost something else than Dijkstra's");
    }
    std::ostringstream out;
    out << "{\"map\": \"" << name << "\", \"lanes\": " << lanes_.size() << ", \"graph_s\": " << graph_built - begin
        << ", \"index_s\": " << index_built - graph_built << ", \"index_mb\": " << after - before
        << ", \"index_arcs\": " << index.hierarchy.arcs() << ", \"queries\": " << queries
        << ", \"without_route\": " << std::count(plain.costs.begin(), plain.costs.end(), kNoRoute)
        << ", \"route_us_median\": " << 1e6 * benchmark::quantile(answers.times, 0.5)
        << ", \"route_us_p99\": " << 1e6 * benchmark::quantile(answers.times, 0.99)
        << ", \"plain_us_median\": " << 1e6 * benchmark::quantile(plain.times, 0.5)
        << ", \"plain_us_p99\": " << 1e6 * benchmark::quantile(plain.times, 0.99) << "}";
    return out.str();
  }

 private:
  LanePoint anyPlace() {
    const LaneIndex lane = lanes_[std::uniform_int_distribution<std::size_t>(0, lanes_.size() - 1)(random_)];
    return {lane, std::uniform_real_distribution<double>(0.0, map_->lane(lane).length())(random_)};
  }

  struct Answers {
    std::vector<double> costs;  // kNoRoute where there is none [m]
    std::vector<double> times;  // of those with a route [s]
  };

  Answers answer(const LaneGraph& graph, const RouteIndex* index, const std::vector<RouteQuery>& queries) const {
    Answers answers;
    for (const RouteQuery& query : queries) {
      const BlockedLanes blocked(query.black_list);
      const double begin = now();
      const SearchResult found =
          searchRoute(graph, index, params_, ChangeRule::kWithRoom, query, blocked, CancelToken());
      answers.costs.push_back(found.labels.empty() ? kNoRoute : buildRoute(graph, blocked, found.labels).cost);
      if (!found.labels.empty()) answers.times.push_back(now() - begin);
    }
    return answers;
  }

  static int differences(const std::vector<double>& a, const std::vector<double>& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > kSameCost;
    return count;
  }

  std::shared_ptr<const HdMap> map_;
  const RouterParams params_;
  std::vector<LaneIndex> lanes_;
  std::mt19937 random_{1};
};

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  using namespace external_command;  // NOLINT(build/namespaces)
  return benchmark::measureMaps(argc, argv, [](std::shared_ptr<const HdMap> map, const std::string& name) {
    return Measurement(std::move(map)).run(name);
  });
}
