// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "external_command/routing/router.h"
#include "support/map_builder.h"
#include "support/route_matchers.h"

namespace external_command {

/// `statement` throws `Exception` with a text that holds `part`.
#define EXPECT_THAT_REFUSED(statement, Exception, part)                                     \
  try {                                                                                     \
    statement;                                                                              \
    ADD_FAILURE() << #statement " was not refused";                                         \
  } catch (const Exception& refused) {                                                      \
    EXPECT_NE(std::string(refused.what()).find(part), std::string::npos) << refused.what(); \
  }

/// A small map and routes on it, each of which is checked against the map.
class RoutingWorld : public testing::Test {
 protected:
  struct Place {
    std::string lane;
    double s;
  };

  struct Part {
    std::string lane;
    double from, to;
  };

  MapBuilder builder;
  RouterParams params;

  const HdMap& map() {
    if (!map_) map_ = builder.build();
    return *map_;
  }

  /// Of the map as it is now.
  const Router& router() {
    map_ = builder.build();
    router_ = std::make_unique<Router>(map_, params);
    return *router_;
  }

  LanePoint point(const std::string& lane, double s) { return {laneIndex(map(), lane), s}; }
  LaneRange range(const std::string& lane, double from, double to) { return {laneIndex(map(), lane), from, to}; }

  Route search(const RouteQuery& query) {
    const Route route = router().findRoute(query, CancelToken());
    EXPECT_TRUE(isConnected(route, map()));
    EXPECT_TRUE(beginsAndEndsAsAsked(route, query));
    EXPECT_TRUE(changesHaveRoom(route, map(), params.min_turning_radius));
    EXPECT_TRUE(avoids(route, map(), query.black_list));
    return route;
  }

  Route drive(const Place& start, const std::vector<std::vector<Place>>& via, const Place& goal,
              const std::vector<Part>& black_list = {}) {
    RouteQuery query{{point(start.lane, start.s)}, {}, {point(goal.lane, goal.s)}, {}};
    for (const auto& candidates : via) {
      query.via.emplace_back();
      for (const Place& place : candidates) query.via.back().push_back(point(place.lane, place.s));
    }
    for (const Part& part : black_list) query.black_list.push_back(range(part.lane, part.from, part.to));
    return search(query);
  }

  Route drive(const Place& start, const Place& goal) { return drive(start, {}, goal); }

  std::string ids(const Route& route) { return laneIds(route, map()); }

 private:
  std::shared_ptr<const HdMap> map_;
  std::unique_ptr<Router> router_;
};

}  // namespace external_command
