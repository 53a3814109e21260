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
    for (int i = 0; i < queries; ++i) query(graph, index);
    std::ostringstream out;
    out << "{\"map\": \"" << name << "\", \"lanes\": " << lanes_.size() << ", \"graph_s\": " << graph_built - begin
        << ", \"index_s\": " << index_built - graph_built << ", \"index_mb\": " << after - before
        << ", \"index_arcs\": " << index.hierarchy.arcs() << ", \"queries\": " << queries
        << ", \"without_route\": " << without_route_ << ", \"route_m_median\": " << quantile(distances_, 0.5)
        << ", \"route_us_median\": " << 1e6 * quantile(times_, 0.5)
        << ", \"route_us_p99\": " << 1e6 * quantile(times_, 0.99)
        << ", \"plain_us_median\": " << 1e6 * quantile(plain_times_, 0.5)
        << ", \"plain_us_p99\": " << 1e6 * quantile(plain_times_, 0.99) << ", \"other_costs\": " << other_costs_ << "}";
    return out.str();
  }

 private:
  LanePoint anyPlace() {
    const LaneIndex lane = lanes_[std::uniform_int_distribution<std::size_t>(0, lanes_.size() - 1)(random_)];
    return {lane, std::uniform_real_distribution<double>(0.0, map_->lane(lane).length())(random_)};
  }

  void query(const LaneGraph& graph, const RouteIndex& index) {
    const RouteQuery query{{anyPlace()}, {}, {anyPlace()}, {}};
    std::vector<double> plain_times, times;
    const double plain = cost(graph, nullptr, query, &plain_times);
    const double cost_by_index = cost(graph, &index, query, &times);
    if (std::abs(plain - cost_by_index) > kSameCost) ++other_costs_;
    if (plain < 0.0) {
      ++without_route_;
      return;
    }
    plain_times_.push_back(plain_times.front());
    times_.push_back(times.front());
    distances_.push_back(plain);
  }

  double cost(const LaneGraph& graph, const RouteIndex* index, const RouteQuery& query, std::vector<double>* times) {
    const BlockedLanes blocked(query.black_list);
    const double begin = now();
    const SearchResult found = searchRoute(graph, index, params_, ChangeRule::kWithRoom, query, blocked, CancelToken());
    if (found.labels.empty()) return -1.0;
    const Route route = buildRoute(graph, blocked, found.labels);
    times->push_back(now() - begin);
    return route.cost;
  }

  std::shared_ptr<const HdMap> map_;
  const RouterParams params_;
  std::vector<LaneIndex> lanes_;
  std::mt19937 random_{1};
  int without_route_ = 0, other_costs_ = 0;
  std::vector<double> times_, plain_times_, distances_;
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
