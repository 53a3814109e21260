// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/conversions.h"

#include <gtest/gtest.h>

#include "external_command/ros/routing_task.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

/// A lane for both directions, 200 m to the east.
class LaneForBothDirections : public testing::Test {
 protected:
  static std::shared_ptr<const HdMap> build() {
    MapBuilder builder;
    builder.lane("two_way", {0, 0}, {200, 0});
    builder["two_way"].direction = LaneDirection::kBidirection;
    return builder.build();
  }

  const std::shared_ptr<const HdMap> map = build();
  const LaneIndex west = *map->lane(laneIndex(*map, "two_way")).reverse;
};

TEST_F(LaneForBothDirections, HasFallingArcLengthsInTheRoutingResponseWhereItIsDrivenBack) {
  RoutingTask task;
  task.query = {{{west, 50.0}}, {{{west, 80.0}}}, {{west, 150.0}}, {}};
  const Route route = Router(map, {}).findRoute(task.query, CancelToken());
  const RoutingResponse response = toRoutingResponse(*map, route);
  ASSERT_EQ(response.road.size(), 1u);
  const LaneSegment& segment = response.road[0].passage.at(0).segment.at(0);
  EXPECT_EQ(segment.id, "two_way");
  EXPECT_NEAR(segment.start_s, 150.0, 1e-9);
  EXPECT_NEAR(segment.end_s, 50.0, 1e-9);

  const RoutingRequest request = requestOf(*map, task, route);
  ASSERT_EQ(request.waypoint.size(), 3u);
  EXPECT_NEAR(request.waypoint[1].s, 120.0, 1e-9);
  EXPECT_NEAR(request.waypoint[1].pose.x, 120.0, 1e-9);
  EXPECT_NEAR(std::abs(request.waypoint[1].heading), M_PI, 1e-9) << "as it is driven";
}

/// B lies right of A; each calls the other its left neighbour.
TEST(RoutingResponse, SaysTheSideOnWhichANeighbourLies) {
  MapBuilder builder;
  builder.lane("A", {0, 0}, {200, 0}).lane("B", {0, -3.5}, {200, -3.5});
  builder["A"].left_forward = {"B"};
  builder["B"].left_forward = {"A"};
  builder["A"].right.types = builder["B"].left.types = {{0.0, BoundaryType::kDottedWhite}};
  const auto map = builder.build();
  const RouteQuery query{{{laneIndex(*map, "A"), 5.0}}, {}, {{laneIndex(*map, "B"), 190.0}}, {}};
  const RoutingResponse response = toRoutingResponse(*map, Router(map, {}).findRoute(query, CancelToken()));
  bool changes = false;
  for (const RoadSegment& road : response.road) {
    for (const Passage& passage : road.passage) {
      changes = changes || passage.change_lane_type == Passage::RIGHT;
      EXPECT_NE(passage.change_lane_type, Passage::LEFT);
    }
  }
  EXPECT_TRUE(changes);
}

}  // namespace
}  // namespace external_command
