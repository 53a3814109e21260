// SPDX-License-Identifier: Apache-2.0
// Random routes on maps that other people made. Skipped where they do not lie beside the checkout.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "external_command/map/map_reader.h"
#include "external_command/routing/reference_path.h"
#include "support/command_path_matcher.h"
#include "support/reference_dijkstra.h"
#include "support/route_matchers.h"

namespace external_command {
namespace {

constexpr int kRequests = 200;
constexpr double kAmpleRoom = 40.0;  // [m] for a lane change
constexpr unsigned kPlaceSeed = 20240611;

class RealMapRoutes : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string file = std::string(EC_SHARED_DIR) + "/data/maps/" + GetParam();
    if (!std::ifstream(file)) GTEST_SKIP() << "no map " << file;
    map_ = readMap(file, {});
    for (LaneIndex i = 0; i < map_->lanes().size(); ++i) {
      if (map_->lane(i).isDrivable()) lanes_.push_back(i);
    }
  }

  /// A place at least `margin` [m] inside a lane.
  LanePoint anyPlace(double margin = 0.5) {
    const LaneIndex lane = anyLane();
    return {lane, std::uniform_real_distribution<double>(margin, map_->lane(lane).length() - margin)(random_)};
  }

  LaneIndex anyLane() { return lanes_[std::uniform_int_distribution<std::size_t>(0, lanes_.size() - 1)(random_)]; }

  RouteQuery anyQuery() { return {{anyPlace()}, {}, {anyPlace()}, {}}; }

  /// nullopt where there is none; each is checked against the map and the query.
  std::optional<Route> route(const Router& router, const RouteQuery& query) {
    SCOPED_TRACE(described(query));
    try {
      const Route found = router.findRoute(query, CancelToken());
      EXPECT_TRUE(isConnected(found, *map_));
      EXPECT_TRUE(beginsAndEndsAsAsked(found, query));
      EXPECT_TRUE(changesHaveRoom(found, *map_, router.params().min_turning_radius));
      EXPECT_TRUE(avoids(found, *map_, query.black_list));
      return found;
    } catch (const NoRoute&) {
      return std::nullopt;
    }
  }

  std::string described(const RouteQuery& query) const {
    const LanePoint &start = query.starts[0], &goal = query.goals[0];
    return map_->lane(start.lane).id + " at " + std::to_string(start.s) + " to " + map_->lane(goal.lane).id + " at " +
           std::to_string(goal.s);
  }

  double reference(const RouteQuery& query) const {
    return referenceCost(*map_, query, RouterParams().lane_change_price);
  }

  static bool hasChanges(const Route& route) {
    return std::any_of(route.steps.begin(), route.steps.end(),
                       [](const RouteStep& step) { return step.change_after != LaneChange::kNone; });
  }

  static bool hasRoom(const Route& route, double length) {
    for (const RouteStep& step : route.steps) {
      if (step.change_after != LaneChange::kNone && step.change_room < length) return false;
    }
    return true;
  }

  /// A router to which lane changes need next to no room, as to the reference.
  static RouterParams inNoRoom() {
    RouterParams params;
    params.min_lane_change_length = 0.1;
    params.min_turning_radius = 0.1;
    return params;
  }

  std::shared_ptr<const HdMap> map_;
  std::vector<LaneIndex> lanes_;
  std::mt19937 random_{kPlaceSeed};
};

TEST_P(RealMapRoutes, CostWhatAPlainDijkstraHasThemCost) {
  const Router in_no_room(map_, inNoRoom());
  const Router usual(map_, RouterParams());
  for (int i = 0; i < kRequests; ++i) {
    const RouteQuery query = anyQuery();
    SCOPED_TRACE(described(query));
    const double expected = reference(query);
    const auto shortest = route(in_no_room, query);
    const auto found = route(usual, query);
    ASSERT_EQ(shortest.has_value(), std::isfinite(expected));
    if (shortest) {
      EXPECT_NEAR(shortest->cost, expected, 0.001);
    }
    if (!found) continue;
    EXPECT_GE(found->cost, expected - 0.001);
    if (hasRoom(*shortest, kAmpleRoom)) {
      EXPECT_NEAR(found->cost, expected, 0.001);
    }
  }
}

TEST_P(RealMapRoutes, AvoidClosedLanesAsAPlainDijkstraDoes) {
  const Router router(map_, inNoRoom());
  for (int i = 0; i < kRequests; ++i) {
    RouteQuery query = anyQuery();
    for (int k = 0; k < 5; ++k) {
      const LaneIndex lane = anyLane();
      query.black_list.push_back({lane, 0.0, map_->lane(lane).length()});
    }
    SCOPED_TRACE(described(query));
    const double expected = reference(query);
    const auto found = route(router, query);
    ASSERT_EQ(found.has_value(), std::isfinite(expected));
    if (found) {
      EXPECT_NEAR(found->cost, expected, 0.001);
    }
  }
}

TEST_P(RealMapRoutes, AvoidClosedPartsOfLanes) {
  const Router router(map_, RouterParams());
  for (int i = 0; i < kRequests; ++i) {
    RouteQuery query = anyQuery();
    const auto open = route(router, query);
    for (int k = 0; k < 8; ++k) {
      const LanePoint from = anyPlace();
      query.black_list.push_back({from.lane, from.s, std::min(from.s + 5.0, map_->lane(from.lane).length())});
    }
    const auto found = route(router, query);
    if (!found) continue;
    ASSERT_TRUE(open);
    EXPECT_GE(found->cost, open->cost - 40.0) << "parts of a lane may count as the lane beside it";
  }
}

TEST_P(RealMapRoutes, PassTheirWayPoints) {
  const Router router(map_, RouterParams());
  for (int i = 0; i < kRequests; ++i) {
    RouteQuery query = anyQuery();
    query.via = {{anyPlace()}, {anyPlace()}};
    const auto found = route(router, query);
    const RouteQuery legs[] = {{query.starts, {}, query.via[0], {}},
                               {query.via[0], {}, query.via[1], {}},
                               {query.via[1], {}, query.goals, {}}};
    double cost = 0.0;
    bool all_found = true;
    for (const RouteQuery& leg : legs) {
      const auto part = route(router, leg);
      all_found = all_found && part;
      cost += part ? part->cost : 0.0;
    }
    ASSERT_EQ(found.has_value(), all_found);
    if (found) {
      EXPECT_NEAR(found->cost, cost, 0.001);
    }
  }
}

TEST_P(RealMapRoutes, TakeTheBestOfSeveralEnds) {
  const Router router(map_, RouterParams());
  for (int i = 0; i < kRequests / 4; ++i) {
    const RouteQuery query{{anyPlace(), anyPlace(), anyPlace()}, {}, {anyPlace(), anyPlace()}, {}};
    double best = std::numeric_limits<double>::infinity();
    for (const LanePoint& start : query.starts) {
      for (const LanePoint& goal : query.goals) {
        if (const auto part = route(router, {{start}, {}, {goal}, {}})) best = std::min(best, part->cost);
      }
    }
    const auto found = route(router, query);
    ASSERT_EQ(found.has_value(), std::isfinite(best));
    if (found) {
      EXPECT_NEAR(found->cost, best, 0.001);
    }
  }
}

TEST_P(RealMapRoutes, HavePathsThatCanBeDriven) {
  const Router router(map_, RouterParams());
  const ReferencePathParams params;
  for (int i = 0; i < kRequests; ++i) {
    const RouteQuery query = anyQuery();
    SCOPED_TRACE(described(query));
    const auto found = route(router, query);
    if (!found) continue;
    ReferencePath reference = referencePath(*map_, *found, VehicleParams(), params, {});
    Path& path = reference.path;
    limitSpeeds(VehicleParams(), &path);
    CommandPathLimits limits;
    limits.curvature = reference.tight.empty();
    EXPECT_TRUE(isDrivableCommandPath(path, VehicleParams(), std::nullopt, limits));
    EXPECT_TRUE(staysNear(path, *found, *map_, hasChanges(*found) ? 2.5 : 1.1));
    const Point2d start = map_->lane(query.starts[0].lane).center.pointAt(query.starts[0].s);
    const Point2d goal = map_->lane(query.goals[0].lane).center.pointAt(query.goals[0].s);
    EXPECT_LT((path.front().pose().position() - start).norm(), 1e-6);
    EXPECT_LT((path.back().pose().position() - goal).norm(), 1e-6);
    EXPECT_NEAR(path.back().s, found->distance, 0.05 * found->distance + 5.0);
    for (std::size_t k = 0; k < path.size() && path[k].s < path.back().s - 5.0; ++k) {
      EXPECT_GE(path[k].speed, 0.999) << "at point " << k << " of curvature " << path[k].kappa;
    }
  }
}

TEST_P(RealMapRoutes, HavePassagesThatFollowEachOther) {
  const Router router(map_, RouterParams());
  for (int i = 0; i < kRequests; ++i) {
    const RouteQuery query = anyQuery();
    SCOPED_TRACE(described(query));
    const auto found = route(router, query);
    if (!found) continue;
    double length = 0.0;
    for (const RouteSegment& segment : toSegments(*map_, *found)) {
      int exits = 0;
      for (const RoutePassage& passage : segment.passages) {
        exits += passage.can_exit;
        ASSERT_EQ(passage.can_exit, passage.change == LaneChange::kNone);
        for (const LaneRange& lane : passage.lanes) length += passage.can_exit ? lane.to_s - lane.from_s : 0.0;
      }
      ASSERT_EQ(exits, 1);
    }
    EXPECT_NEAR(length, found->distance, 0.02 * found->distance + 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, RealMapRoutes,
                         testing::Values("town01/base_map.bin", "town01/sim_map.bin", "town10hd/base_map.bin",
                                         "town10hd/sim_map.bin", "autonomoustuff/base_map.bin"),
                         [](const auto& map) {
                           std::string name = map.param;
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace external_command
