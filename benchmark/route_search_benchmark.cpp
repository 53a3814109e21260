// SPDX-License-Identifier: Apache-2.0
//
// route_search_benchmark [--city CROSSINGS_PER_SIDE]... FILE...
// Measures, for each map file and made-up city, routes between random places of its lanes, lane list included: by the
// search with its index, and by the same without it (Dijkstra), whose costs must be the same. Prints one JSON
// array.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

#include "../src/routing/route_builder.h"
#include "../src/routing/route_search.h"
#include "external_command/map/map_reader.h"
#include "grid_city.h"

namespace external_command {
namespace {

constexpr double kSameCost = 0.001;  // [m]
constexpr double kNoRoute = -1.0;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

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
    std::ostringstream out;
    out << "{\"map\": \"" << name << "\", \"lanes\": " << lanes_.size() << ", \"graph_s\": " << graph_built - begin
        << ", \"index_s\": " << index_built - graph_built << ", \"index_mb\": " << after - before
        << ", \"index_arcs\": " << index.hierarchy.arcs() << ", \"queries\": " << queries
        << ", \"without_route\": " << std::count(plain.costs.begin(), plain.costs.end(), kNoRoute)
        << ", \"route_us_median\": " << 1e6 * quantile(answers.times, 0.5)
        << ", \"route_us_p99\": " << 1e6 * quantile(answers.times, 0.99)
        << ", \"plain_us_median\": " << 1e6 * quantile(plain.times, 0.5)
        << ", \"plain_us_p99\": " << 1e6 * quantile(plain.times, 0.99)
        << ", \"other_costs\": " << differences(answers.costs, plain.costs) << "}";
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

int run(int argc, char** argv) {
  std::string separator = "[";
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool is_city = argument == "--city" && i + 1 < argc;
    const std::string name = is_city ? std::string("city ") + argv[++i] : argument;
    const auto map =
        is_city ? std::make_shared<const HdMap>(gridCity(std::stoi(argv[i])), Point2d::Zero()) : readMap(argument, {});
    std::cout << separator << Measurement(map).run(name) << std::flush;
    separator = ",\n ";
  }
  std::cout << "]\n";
  return 0;
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: " << argv[0] << " [--city CROSSINGS_PER_SIDE]... FILE...\n";
    return 2;
  }
  try {
    return external_command::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
