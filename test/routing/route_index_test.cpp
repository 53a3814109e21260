// SPDX-License-Identifier: Apache-2.0
// The index makes a search faster, and changes no cost: random queries, with and without it.
#include "../../src/routing/route_index.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "../../benchmark/grid_city.h"
#include "../../src/routing/route_search.h"
#include "external_command/core/text.h"
#include "external_command/map/map_reader.h"

namespace external_command {
namespace {

constexpr unsigned kIndexSeed = 20261129;
constexpr double kSameCost = 0.001;  // [m]

/// Random places and queries of a map.
class Queries {
 public:
  explicit Queries(const HdMap& map) : map_(map) {
    for (LaneIndex i = 0; i < map.lanes().size(); ++i) {
      if (map.lane(i).isDrivable()) lanes_.push_back(i);
    }
  }

  double anyOf(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  int anyCount(int most) { return std::uniform_int_distribution<int>(0, most)(random_); }

  LanePoint anyPlace() {
    const LaneIndex lane = lanes_[static_cast<std::size_t>(anyCount(static_cast<int>(lanes_.size()) - 1))];
    return {lane, anyOf(0.0, map_.lane(lane).length()), anyCount(1) * anyOf(0.0, 30.0)};
  }

  std::vector<LanePoint> anyPlaces() {
    std::vector<LanePoint> places{anyPlace()};
    for (int more = anyCount(3) == 0 ? anyCount(3) : 0; more > 0; --more) places.push_back(anyPlace());
    return places;
  }

  RouteQuery any() {
    RouteQuery query{anyPlaces(), {}, anyPlaces(), {}};
    for (int i = anyCount(3) == 0 ? anyCount(2) : 0; i > 0; --i) query.via.push_back(anyPlaces());
    for (int i = anyCount(1) * anyCount(static_cast<int>(lanes_.size()) / 20); i > 0; --i) {
      const LanePoint place = anyPlace();
      const double length = map_.lane(place.lane).length();
      query.black_list.push_back({place.lane, place.s, anyCount(1) == 0 ? length : std::min(place.s + 5.0, length)});
    }
    if (anyCount(9) == 0) query.goals = {{query.starts.front().lane, query.starts.front().s - anyOf(0.0, 1.0)}};
    query.goals.front().s = std::max(query.goals.front().s, 0.0);
    return query;
  }

 private:
  const HdMap& map_;
  std::vector<LaneIndex> lanes_;
  std::mt19937 random_{kIndexSeed};
};

/// A city whose lanes abreast differ in length and do not always begin together: of some streets the outer lane is cut
/// in two, and lanes wind.
std::shared_ptr<const HdMap> unevenCity(int crossings_per_side) {
  MapData data = gridCity(crossings_per_side);
  std::mt19937 random(kIndexSeed);
  const auto share = [&random] { return std::uniform_real_distribution<double>(0.1, 0.9)(random); };
  const std::size_t count = data.lanes.size();
  for (std::size_t i = 0; i < count; ++i) {
    LaneData& lane = data.lanes[i];
    if (lane.center.size() != 2 || lane.left_forward.size() + lane.right_forward.size() == 0) continue;
    const Point2d from = lane.center[0], to = lane.center[1];
    const Point2d along = to - from, across = Point2d(-along.y(), along.x()).normalized();
    const Point2d middle = from + share() * along;
    if (random() % 4 == 0) lane.center = {from, middle + 6.0 * (share() - 0.5) * across, to};
    if (lane.left_forward.empty() || random() % 3 != 0) continue;
    LaneData rest = lane;
    rest.id = lane.id + "_rest";
    rest.center = {middle, to};
    lane.center = {from, middle};
    lane.successors = {rest.id};
    for (LaneData& other : data.lanes) {
      if (other.id == lane.left_forward[0]) other.right_forward.push_back(rest.id);
    }
    data.lanes.push_back(std::move(rest));
  }
  return std::make_shared<const HdMap>(std::move(data), Point2d::Zero());
}

double costOf(const SearchResult& result) { return result.labels.empty() ? -1.0 : result.labels.back().cost; }

/// @return how many of the queries have a route.
int expectSameCosts(const HdMap& map, const RouterParams& params, ChangeRule rule, int queries) {
  const LaneGraph graph(map, params);
  const RouteIndex index(graph, params);
  Queries random(map);
  int found = 0;
  for (int i = 0; i < queries; ++i) {
    const RouteQuery query = random.any();
    const BlockedLanes blocked(query.black_list);
    const SearchResult plain = searchRoute(graph, nullptr, params, rule, query, blocked, CancelToken());
    const SearchResult fast = searchRoute(graph, &index, params, rule, query, blocked, CancelToken());
    found += plain.labels.empty() ? 0 : 1;
    EXPECT_NEAR(costOf(fast), costOf(plain), kSameCost) << "query " << i << " with seed " << kIndexSeed;
    EXPECT_EQ(fast.failed_leg, plain.failed_leg);
    EXPECT_EQ(fast.reached_lanes, plain.reached_lanes) << "without a route all that can be reached is";
  }
  return found;
}

RouterParams withChangePrice(double price) {
  RouterParams params;
  params.lane_change_price = price;
  return params;
}

TEST(RouteIndex, ChangesNoCostInACity) {
  const HdMap map(gridCity(8), Point2d::Zero());
  EXPECT_GT(expectSameCosts(map, RouterParams(), ChangeRule::kWithRoom, 2000), 1000);
}

TEST(RouteIndex, ChangesNoCostWhereLanesAbreastDiffer) {
  const auto map = unevenCity(8);
  EXPECT_GT(expectSameCosts(*map, RouterParams(), ChangeRule::kWithRoom, 2000), 1000);
  EXPECT_GT(expectSameCosts(*map, RouterParams(), ChangeRule::kWithoutRoom, 500), 250);
}

TEST(RouteIndex, ChangesNoCostWhateverAChangeCosts) {
  const auto map = unevenCity(6);
  for (const double price : {0.0, 1.0, 1000.0, 1e6}) {
    SCOPED_TRACE(price);
    EXPECT_GT(expectSameCosts(*map, withChangePrice(price), ChangeRule::kWithRoom, 500), 250);
  }
}

TEST(RouteIndex, ReachesFewLabelsOfACity) {
  const HdMap map(gridCity(30), Point2d::Zero());
  const LaneGraph graph(map, RouterParams());
  const RouteIndex index(graph, RouterParams());
  const RouteQuery query{{{*map.findLane("s0_0_0_0"), 1.0}}, {}, {{*map.findLane("s28_0_0_0"), 1.0}}, {}};
  const auto labels = [&](const RouteIndex* used) {
    const SearchResult result =
        searchRoute(graph, used, RouterParams(), ChangeRule::kWithRoom, query, BlockedLanes({}), CancelToken());
    return result.found_labels;
  };
  EXPECT_LT(20 * labels(&index), labels(nullptr));
}

class RouteIndexOfRealMap : public testing::TestWithParam<const char*> {};

TEST_P(RouteIndexOfRealMap, ChangesNoCost) {
  const std::string file = std::string(EC_SHARED_DIR) + "/data/maps/" + GetParam();
  if (!std::ifstream(file)) GTEST_SKIP() << "no map " << file;
  EXPECT_GT(expectSameCosts(*readMap(file, {}), RouterParams(), ChangeRule::kWithRoom, 1000), 200);
}

INSTANTIATE_TEST_SUITE_P(Maps, RouteIndexOfRealMap,
                         testing::Values("town01/base_map.bin", "town10hd/base_map.bin", "autonomoustuff/base_map.bin"),
                         [](const auto& map) { return std::string(map.param, std::string(map.param).find('/')); });

}  // namespace
}  // namespace external_command
