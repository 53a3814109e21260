// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/lane_way_tool.h"

#include <gtest/gtest.h>

#include "support/routing_world.h"

namespace external_command {
namespace {

constexpr double kWidth = MapBuilder::kLaneWidth;

///   path  --------> a lane for bicycles, 3.5 m to the left of north
///   north --------> 100 m
///   south <--------
class TwoWayRoad : public testing::Test {
 protected:
  TwoWayRoad() {
    builder.lane("path", {0, 2 * kWidth}, {100, 2 * kWidth}).lane("north", {0, kWidth}, {100, kWidth});
    builder.lane("south", {100, 0}, {0, 0});
    builder["path"].type = LaneType::kBiking;
  }

  LaneWayTool tool() {
    map = builder.build();
    return {*map, params};
  }

  std::string id(const LanePoint& point) const { return map->lane(point.lane).id; }

  MapBuilder builder;
  LaneWayParams params;
  std::shared_ptr<const HdMap> map;
};

TEST_F(TwoWayRoad, SnapsAPoseToTheNearestLaneInItsDirection) {
  const LanePoint east = tool().fromPose({30, 1.0}, 0.1, "end_pose");
  EXPECT_EQ(id(east), "north") << "the nearer one leads the other way";
  EXPECT_NEAR(east.s, 30.0, 1e-9);
  EXPECT_EQ(id(tool().fromPose({30, 1.0}, M_PI, "end_pose")), "south");
}

TEST_F(TwoWayRoad, SnapsAPoseWithoutHeadingToTheNearestLaneAtAll) {
  EXPECT_EQ(id(tool().fromPose({30, 1.0}, std::nullopt, "end_pose")), "south");
  EXPECT_EQ(id(tool().fromPose({30, 500.0}, std::nullopt, "end_pose")), "north") << "bicycles are not for us";
}

TEST_F(TwoWayRoad, RefusesAPoseTooFarFromEveryLane) {
  EXPECT_NO_THROW(tool().fromPose({30, kWidth + 2.9}, 0.0, "end_pose"));
  EXPECT_THAT_REFUSED(tool().fromPose({30, kWidth + 3.1}, 0.0, "end_pose"), OffMap,
                      "end_pose (30.00, 6.60, 0.000) is 3.10 m from the nearest lane north, whose heading differs by 0 "
                      "rad; the limits are 3.00 m (~snap_distance) and 1 rad (~snap_heading)");
}

TEST_F(TwoWayRoad, RefusesAPoseAcrossEveryLane) {
  EXPECT_NO_THROW(tool().fromPose({30, kWidth}, 0.99, "end_pose"));
  EXPECT_THAT_REFUSED(tool().fromPose({30, kWidth}, 1.01, "way_point[0]"), OffMap, "differs by 1.01 rad");
}

TEST_F(TwoWayRoad, RefusesAPoseThatIsNotFinite) {
  EXPECT_THAT_REFUSED(tool().fromPose({NAN, 0}, 0.0, "end_pose"), InvalidRequest, "end_pose is not finite");
  EXPECT_THAT_REFUSED(tool().fromPose({0, 0}, INFINITY, "end_pose"), InvalidRequest, "end_pose is not finite");
  EXPECT_THAT_REFUSED(tool().fromVehicle({NAN, 0, 0}), InvalidRequest, "vehicle");
}

TEST_F(TwoWayRoad, SaysThatNothingIsForDriving) {
  builder["north"].type = builder["south"].type = LaneType::kSidewalk;
  EXPECT_THAT_REFUSED(tool().fromPose({30, 1}, std::nullopt, "end_pose"), OffMap, "no lane to drive on");
  EXPECT_THAT_REFUSED(tool().fromVehicle({30, 1, 0}), OffMap, "no");
}

TEST_F(TwoWayRoad, DoesNotSnapToLanesThatAreDrivenBackwards) {
  builder["south"].direction = LaneDirection::kBackward;
  EXPECT_EQ(id(tool().fromPose({30, 0.1}, std::nullopt, "end_pose")), "north");
}

TEST_F(TwoWayRoad, TakesALaneByItsId) {
  const LanePoint point = tool().fromLane("north", 12.5, "waypoint[0]");
  EXPECT_EQ(id(point), "north");
  EXPECT_EQ(point.s, 12.5);
  EXPECT_EQ(tool().fromLane("north", 100.05, "waypoint[0]").s, 100.0) << "files round their lengths";
}

TEST_F(TwoWayRoad, RefusesALaneThatIsNotThereOrNotForDriving) {
  EXPECT_THAT_REFUSED(tool().fromLane("west", 1, "waypoint[0]"), InvalidRequest, "waypoint[0] names lane 'west'");
  EXPECT_THAT_REFUSED(tool().fromLane("path", 1, "waypoint[0]"), InvalidRequest, "path, which is not for driving");
  EXPECT_THAT_REFUSED(tool().fromLane("north", 101, "waypoint[0]"), InvalidRequest, "goes from 0 to 100.00 m");
  EXPECT_THAT_REFUSED(tool().fromLane("north", NAN, "waypoint[0]"), InvalidRequest, "goes from 0 to 100.00 m");
}

TEST_F(TwoWayRoad, StartsAVehicleOnItsOwnLane) {
  const auto starts = tool().fromVehicle({30, 1.9, 1.0});
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(id(starts[0]), "north");
  EXPECT_FALSE(tool().isOffLane({30, 1.9, 1.0}));
}

TEST_F(TwoWayRoad, StartsAVehicleOffTheLanesOnAnyLaneAround) {
  for (const Pose2d& vehicle : {Pose2d{30, -2.1, M_PI}, Pose2d{30, 1.9, 1.4}}) {
    EXPECT_TRUE(tool().isOffLane(vehicle));
    EXPECT_EQ(tool().fromVehicle(vehicle).size(), 2u);
  }
  EXPECT_EQ(id(tool().fromVehicle({30, -2.1, 0.0})[0]), "south") << "the nearest first";
}

TEST_F(TwoWayRoad, RefusesAVehicleFarFromTheLanes) {
  EXPECT_EQ(tool().fromVehicle({30, -19, 0}).size(), 1u);
  EXPECT_THAT_REFUSED(tool().fromVehicle({30, -21, 0}), OffMap, "the limit is 20.00 m (~park_and_go_radius)");
}

TEST_F(TwoWayRoad, ParksFromTheLanesThatOverlapTheSpace) {
  builder.parkingSpace("P1", {40, -5, M_PI / 2}, 5.0, 2.5, {"south"});
  bool used_geometry = true;
  const auto goals = tool().fromParkingSpace("P1", &used_geometry);
  ASSERT_EQ(goals.size(), 1u);
  EXPECT_EQ(id(goals[0]), "south");
  EXPECT_NEAR(goals[0].s, 60.0, 1e-6) << "abreast of the space";
  EXPECT_FALSE(used_geometry);
}

TEST_F(TwoWayRoad, ParksFromTheLanesAroundWhereTheMapHasNoOverlaps) {
  builder.parkingSpace("P1", {40, -5, M_PI / 2}, 5.0, 2.5);
  builder.parkingSpace("P2", {40, -50, M_PI / 2}, 5.0, 2.5);
  builder.parkingSpace("P3", {40, 12, M_PI / 2}, 5.0, 2.5, {"path"});
  bool used_geometry = false;
  EXPECT_EQ(tool().fromParkingSpace("P1", &used_geometry).size(), 2u);
  EXPECT_TRUE(used_geometry);
  EXPECT_EQ(tool().fromParkingSpace("P3", nullptr).size(), 2u) << "it overlaps no lane for driving";
  EXPECT_THAT_REFUSED(tool().fromParkingSpace("P2", nullptr), OffMap, "within 20.00 m (~parking_lane_radius)");
  EXPECT_THAT_REFUSED(tool().fromParkingSpace("P9", nullptr), InvalidRequest, "parking_spot_id 'P9'");
}

TEST_F(TwoWayRoad, RefusesParametersOutOfRange) {
  params.snap_distance = -1.0;
  EXPECT_THAT_REFUSED(params.validate(), InvalidParameter, "snap_distance is -1");
  EXPECT_NO_THROW(LaneWayParams().validate());
}

}  // namespace
}  // namespace external_command
