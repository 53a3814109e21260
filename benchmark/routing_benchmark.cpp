// SPDX-License-Identifier: Apache-2.0
//
// routing_benchmark [--city CROSSINGS_PER_SIDE]... FILE...
// Measures, for each map file and made-up city, how long routes between random places of its lanes take, and their
// reference paths; and routes between poses beside the lanes, for which several lanes are candidates. Prints one JSON
// array.
#include <algorithm>
#include <chrono>
#include <random>
#include <sstream>

#include "external_command/routing/lane_way_tool.h"
#include "external_command/routing/reference_paths.h"
#include "measure_maps.h"
#include "path_quality.h"
#include "statistics.h"

namespace external_command {
namespace {

constexpr int kQueries = 1000;
constexpr double kBeside = 1.75;  // [m]
constexpr std::size_t kPathsLookedAt = 400;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

class Measurement {
 public:
  explicit Measurement(std::shared_ptr<const HdMap> map)
      : map_(std::move(map)), paths_(map_, vehicle_, ReferencePathParams()), quality_(*map_, vehicle_) {
    for (LaneIndex i = 0; i < map_->lanes().size(); ++i) {
      if (map_->lane(i).isDrivable()) lanes_.push_back(i);
    }
  }

  std::string run(const std::string& name) {
    const double begin = now();
    const Router router(map_, RouterParams());
    const double build = now() - begin;
    for (int i = 0; i < kQueries; ++i) query(router);
    for (int i = 0; i < kQueries; ++i) queryBesideLanes(router);
    std::ostringstream out;
    out << "{\"map\": \"" << name << "\", \"lanes\": " << lanes_.size() << ", \"router_build_s\": " << build
        << ", \"queries\": " << kQueries << ", \"without_route\": " << kQueries - route_times_.size()
        << ", \"route_us_median\": " << 1e6 * benchmark::quantile(route_times_, 0.5)
        << ", \"route_us_p99\": " << 1e6 * benchmark::quantile(route_times_, 0.99)
        << ", \"route_m_median\": " << benchmark::quantile(distances_, 0.5)
        << ", \"changes_per_km\": " << 1000.0 * changes_ / std::max(metres_, 1.0)
        << ", \"candidates_mean\": " << candidates_ / (2.0 * kQueries)
        << ", \"beside_lanes_us_median\": " << 1e6 * benchmark::quantile(beside_times_, 0.5)
        << ", \"beside_lanes_us_p99\": " << 1e6 * benchmark::quantile(beside_times_, 0.99)
        << ", \"path_us_per_km_median\": " << 1e6 * benchmark::quantile(path_times_per_km_, 0.5)
        << ", \"path_us_per_km_p99\": " << 1e6 * benchmark::quantile(path_times_per_km_, 0.99)
        << ", \"paths_looked_at\": " << quality_.paths() << ", \"over_curvature_share\": " << quality_.shareOverLimit()
        << ", \"over_curvature_untold_share\": " << quality_.shareUntold()
        << ", \"worst_curvature\": " << quality_.largestKappa() << ", \"faulty_paths\": " << quality_.faulty()
        << ", \"first_fault\": \"" << quality_.firstFault() << "\""
        << ", \"footprint_out_of_lanes_m\": " << quality_.largestExcess()
        << ", \"axle_out_of_lanes_m\": " << quality_.largestOffset()
        << ", \"no_route_us_median\": " << 1e6 * benchmark::quantile(failure_times_, 0.5) << "}";
    return out.str();
  }

 private:
  LanePoint anyPlace() {
    const LaneIndex lane = lanes_[std::uniform_int_distribution<std::size_t>(0, lanes_.size() - 1)(random_)];
    return {lane, std::uniform_real_distribution<double>(0.0, map_->lane(lane).length())(random_)};
  }

  void query(const Router& router) {
    const RouteQuery query{{anyPlace()}, {}, {anyPlace()}, {}};
    const double begin = now();
    try {
      const Route route = router.findRoute(query, CancelToken());
      const double found = now();
      const ReferencePath path = paths_.find(route, {});
      const double end = now();
      route_times_.push_back(found - begin);
      distances_.push_back(route.distance);
      metres_ += route.distance;
      for (const RouteStep& step : route.steps) changes_ += step.change_after != LaneChange::kNone;
      if (path.path.back().s > 100.0) path_times_per_km_.push_back((end - found) / path.path.back().s * 1000.0);
      if (quality_.paths() < kPathsLookedAt) quality_.add(path.path, !path.tight.empty());
    } catch (const NoRoute&) {
      failure_times_.push_back(now() - begin);
    }
  }

  /// As far to the side of a lane as the one beside it would be: which of the two is meant?
  Point2d anyPlaceBesideALane() {
    const LanePoint place = anyPlace();
    const Pose2d pose = map_->lane(place.lane).center.poseAt(place.s);
    return pose.position() + kBeside * unitVector(pose.heading + M_PI / 2.0);
  }

  void queryBesideLanes(const Router& router) {
    const LaneWayTool tool(*map_, {});
    const Point2d from = anyPlaceBesideALane(), to = anyPlaceBesideALane();
    const double begin = now();
    const RouteQuery query{tool.fromPose(from, {}, "start"), {}, tool.fromPose(to, {}, "goal"), {}};
    candidates_ += static_cast<double>(query.starts.size() + query.goals.size());
    try {
      router.findRoute(query, CancelToken());
    } catch (const NoRoute&) {
      return;
    }
    beside_times_.push_back(now() - begin);
  }

  std::shared_ptr<const HdMap> map_;
  const VehicleParams vehicle_;
  const ReferencePaths paths_;
  PathQuality quality_;
  std::vector<LaneIndex> lanes_;
  std::mt19937 random_{1};
  double metres_ = 0.0, changes_ = 0.0, candidates_ = 0.0;
  std::vector<double> beside_times_;
  std::vector<double> route_times_, failure_times_, distances_, path_times_per_km_;
};

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  using namespace external_command;  // NOLINT(build/namespaces)
  return benchmark::measureMaps(argc, argv, [](std::shared_ptr<const HdMap> map, const std::string& name) {
    return Measurement(std::move(map)).run(name);
  });
}
