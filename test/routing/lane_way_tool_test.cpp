// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/lane_way_tool.h"

#include <gtest/gtest.h>

#include "support/routing_world.h"

namespace external_command {
namespace {

///   path  --------> a lane for bicycles, 3.5 m to the left of north
///   north --------> 100 m
///   south <--------
class TwoWayRoad : public testing::Test {
 protected:
  TwoWayRoad() {
    builder.lane("path", {0, 2 * MapBuilder::kLaneWidth}, {100, 2 * MapBuilder::kLaneWidth})
        .lane("north", {0, MapBuilder::kLaneWidth}, {100, MapBuilder::kLaneWidth});
    builder.lane("south", {100, 0}, {0, 0});
    builder["path"].type = LaneType::kBiking;
  }

  LaneWayTool tool() {
    map = builder.build();
    return {*map, params};
  }

  std::string id(const LanePoint& point) const { return map->lane(point.lane).id; }

  std::string ids(const std::vector<LanePoint>& points) const {
    std::string text;
    for (const LanePoint& point : points) text += (text.empty() ? "" : " ") + id(point);
    return text;
  }

  MapBuilder builder;
  LaneWayParams params;
  std::shared_ptr<const HdMap> map;
};

TEST_F(TwoWayRoad, SnapsAPoseToTheNearestLaneInItsDirection) {
  const auto east = tool().fromPose({30, 1.0}, 0.1, "end_pose");
  ASSERT_EQ(ids(east), "north") << "the nearer one leads the other way";
  EXPECT_NEAR(east[0].s, 30.0, 1e-9);
  EXPECT_EQ(ids(tool().fromPose({30, 1.0}, M_PI, "end_pose")), "south");
}

TEST_F(TwoWayRoad, SnapsAPoseWithoutHeadingToTheNearestLaneAtAll) {
  EXPECT_EQ(ids(tool().fromPose({30, 1.0}, std::nullopt, "end_pose")), "south");
  EXPECT_EQ(ids(tool().fromPose({30, MapBuilder::kLaneWidth + 8.0}, std::nullopt, "end_pose")), "north")
      << "bicycles are not for us";
}

TEST_F(TwoWayRoad, RefusesAPoseWithoutHeadingFarFromEveryLane) {
  EXPECT_NO_THROW(tool().fromPose({30, -9.9}, std::nullopt, "end_pose"));
  EXPECT_THAT_REFUSED(tool().fromPose({30, -10.1}, std::nullopt, "end_pose"), OffMap,
                      "end_pose (30.00, -10.10) is 10.10 m from the nearest lane south; the limit is 10.00 m "
                      "(~max_goal_distance)");
}

TEST_F(TwoWayRoad, TakesEveryLaneThatIsHardlyFurtherOffAtThePriceOfBeingOff) {
  const double middle = MapBuilder::kLaneWidth / 2.0;
  EXPECT_EQ(ids(tool().fromPose({30, middle + 0.4}, std::nullopt, "end_pose")), "north south");
  EXPECT_EQ(ids(tool().fromPose({30, middle - 0.4}, std::nullopt, "end_pose")), "south north");
  EXPECT_EQ(ids(tool().fromPose({30, middle + 0.6}, std::nullopt, "end_pose")), "north");
  const auto points = tool().fromPose({30, middle + 0.4}, std::nullopt, "end_pose");
  EXPECT_NEAR(points[0].price, 1.35 * params.off_lane_price, 1e-9);
  EXPECT_NEAR(points[1].price, 2.15 * params.off_lane_price, 1e-9);
  EXPECT_NEAR(tool().fromPose({30, 0}, M_PI - 0.5, "end_pose")[0].price, 0.5 * params.off_heading_price, 1e-9);
}

TEST_F(TwoWayRoad, RefusesAPoseTooFarFromEveryLane) {
  EXPECT_NO_THROW(tool().fromPose({30, MapBuilder::kLaneWidth + 2.9}, 0.0, "end_pose"));
  EXPECT_THAT_REFUSED(
      tool().fromPose({30, MapBuilder::kLaneWidth + 3.1}, 0.0, "end_pose"), OffMap,
      "end_pose (30.00, 6.60, 0.000) is 3.10 m from the nearest lane north, whose heading differs by 0.00 "
      "rad; the limits are 3.00 m (~snap_distance) and 1.00 rad (~snap_heading)");
}

TEST_F(TwoWayRoad, RefusesAPoseAcrossEveryLane) {
  EXPECT_NO_THROW(tool().fromPose({30, MapBuilder::kLaneWidth}, 0.99, "end_pose"));
  EXPECT_THAT_REFUSED(tool().fromPose({30, MapBuilder::kLaneWidth}, 1.01, "way_point[0]"), OffMap,
                      "differs by 1.01 rad");
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

TEST_F(TwoWayRoad, TakesALaneWhateverItsDirectionSays) {
  builder["south"].direction = LaneDirection::kBackward;
  EXPECT_EQ(ids(tool().fromPose({30, 0.1}, std::nullopt, "end_pose")), "south");
}

TEST_F(TwoWayRoad, TakesALaneByItsId) {
  const LanePoint point = tool().fromLane("north", 12.5, "waypoint[0]");
  EXPECT_EQ(id(point), "north");
  EXPECT_EQ(point.s, 12.5);
  EXPECT_EQ(tool().fromLane("north", 100.05, "waypoint[0]").s, 100.0) << "files round their lengths";
}

TEST_F(TwoWayRoad, RefusesALaneThatIsNotThereOrNotForDriving) {
  EXPECT_THAT_REFUSED(tool().fromLane("west", 1, "waypoint[0]"), InvalidRequest, "waypoint[0] names lane 'west'");
  EXPECT_THAT_REFUSED(tool().fromLane("nroth", 1, "waypoint[0]"), InvalidRequest, "; did you mean 'north'?");
  EXPECT_THAT_REFUSED(tool().fromLane("path", 1, "waypoint[0]"), InvalidRequest, "path, which is not for driving");
  EXPECT_THAT_REFUSED(tool().fromLane("north", 101, "waypoint[0]"), InvalidRequest, "goes from 0 to 100.00 m");
  EXPECT_THAT_REFUSED(tool().fromLane("north", NAN, "waypoint[0]"), InvalidRequest, "goes from 0 to 100.00 m");
}

TEST_F(TwoWayRoad, StartsAVehicleOnItsOwnLane) {
  EXPECT_EQ(ids(tool().fromVehicle({30, 1.9, 1.0})), "north");
  EXPECT_FALSE(tool().isOffLane({30, 1.9, 1.0}));
}

TEST_F(TwoWayRoad, StartsAVehicleOffTheLanesOnAnyLaneAround) {
  for (const Pose2d& vehicle : {Pose2d{30, -2.1, M_PI}, Pose2d{30, 1.9, 1.4}}) {
    EXPECT_TRUE(tool().isOffLane(vehicle));
    EXPECT_EQ(tool().fromVehicle(vehicle).size(), 2u);
  }
  EXPECT_EQ(id(tool().fromVehicle({30, -2.1, 0.0})[0]), "south") << "the nearest first";
}

TEST_F(TwoWayRoad, StartsAVehicleInAnAreaWhereLanesGiveAccessToIt) {
  builder.area("yard", {{20, -8}, {40, -8}, {40, -60}, {20, -60}});
  const auto points = tool().fromVehicle({30, -50, 0});
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(id(points[0]), "south");
  EXPECT_NEAR(points[0].s, 60.0, 1.1) << "the first place that is nearest to the area";
  EXPECT_GT(points[0].price, 40.0);
  params.area_access_distance = 3.0;
  EXPECT_THAT_REFUSED(tool().fromVehicle({30, -50, 0}), OffMap, "park_and_go_radius");
}

TEST_F(TwoWayRoad, RefusesAVehicleFarFromTheLanes) {
  EXPECT_EQ(tool().fromVehicle({30, -19, 0}).size(), 1u);
  EXPECT_THAT_REFUSED(tool().fromVehicle({30, -21, 0}), OffMap, "the limit is 20.00 m (~park_and_go_radius)");
}

TEST_F(TwoWayRoad, DoesNotStartAVehicleOnALaneThatCrossesItsOwn) {
  builder.lane("crossing", {20, MapBuilder::kLaneWidth - 10.0},
               {40, MapBuilder::kLaneWidth + 10.0});  // at 45 degrees, through (30, MapBuilder::kLaneWidth)
  EXPECT_EQ(ids(tool().fromVehicle({30, MapBuilder::kLaneWidth + 0.1, 0.1})), "north");
  EXPECT_EQ(ids(tool().fromVehicle({30, MapBuilder::kLaneWidth + 0.1, 0.7})), "crossing");
  EXPECT_EQ(tool().fromVehicle({30, MapBuilder::kLaneWidth, 0.39}).size(), 2u) << "in between";
}

///   a second deck 6 m above: its lanes lie 0.2 m to the left of those below
TEST_F(TwoWayRoad, StartsAVehicleOnTheDeckOfItsHeight) {
  builder.lane("upper", {0, MapBuilder::kLaneWidth + 0.2}, {100, MapBuilder::kLaneWidth + 0.2});
  const auto setHeight = [this](const char* lane, float z) {
    builder[lane].heights.assign(builder[lane].center.size(), z);
  };
  for (const char* lane : {"north", "south", "path"}) setHeight(lane, 0.0F);
  setHeight("upper", 6.0F);
  const Pose2d vehicle{30, MapBuilder::kLaneWidth + 0.1, 0.0};
  EXPECT_EQ(ids(tool().fromVehicle(vehicle, 6.4)), "upper");
  EXPECT_EQ(ids(tool().fromVehicle(vehicle, 0.3)), "north");
  EXPECT_EQ(tool().fromVehicle(vehicle).size(), 2u) << "no height is known";
  EXPECT_EQ(ids(tool().fromVehicle({30, MapBuilder::kLaneWidth - 0.8, 0.0}, 6.4)), "upper")
      << "the other deck is nearer by 20 cm";
  for (const char* lane : {"north", "south", "path"}) setHeight(lane, 30.0F);
  setHeight("upper", 36.0F);
  EXPECT_EQ(ids(tool().fromVehicle(vehicle, 6.0)), "north") << "the localization counts from elsewhere";
  for (const char* lane : {"north", "south", "path", "upper"}) setHeight(lane, 0.0F);
  EXPECT_EQ(tool().fromVehicle(vehicle, 6.4).size(), 2u) << "the map has no heights";
}

///   a second deck 6 m above, 5 m to the left of the lanes below
class TwoDecks : public TwoWayRoad {
 protected:
  TwoDecks() {
    builder.lane("upper", {0, MapBuilder::kLaneWidth + 5.0}, {100, MapBuilder::kLaneWidth + 5.0});
    for (const char* lane : {"north", "south", "path"}) setHeight(lane, 1.0F);
    setHeight("upper", 7.0F);
  }

  void setHeight(const char* lane, float z) { builder[lane].heights.assign(builder[lane].center.size(), z); }
};

TEST_F(TwoDecks, PutAPoseOnTheDeckOfItsHeight) {
  const Point2d between{30, MapBuilder::kLaneWidth + 1.5};
  EXPECT_EQ(ids(tool().fromPose(between, {}, "end_pose")), "north");
  EXPECT_EQ(ids(tool().fromPose(between, {}, "end_pose", {1.5, ""})), "north");
  EXPECT_EQ(ids(tool().fromPose(between, {}, "end_pose", {6.5, ""})), "upper");
  EXPECT_EQ(ids(tool().fromPose({30, MapBuilder::kLaneWidth + 2.5}, 0.0, "end_pose", {6.5, ""})), "upper");
  EXPECT_THAT_REFUSED(tool().fromPose(between, 0.0, "end_pose", {6.5, ""}), OffMap,
                      "from the nearest lane north, whose heading differs by 0.00 rad and height differs by 5.50 m");
  EXPECT_EQ(ids(tool().fromPose(between, 0.0, "end_pose", {60.0, ""})), "north") << "counted from elsewhere";
}

TEST_F(TwoDecks, HaveAVehicleOffTheLanesOfItsDeckStartOnThatDeck) {
  const Pose2d vehicle{30, MapBuilder::kLaneWidth + 0.5, 0.0};
  EXPECT_FALSE(tool().isOffLane(vehicle, 1.2));
  EXPECT_TRUE(tool().isOffLane(vehicle, 7.2));
  EXPECT_EQ(ids(tool().fromVehicle(vehicle, 1.2)), "north");
  EXPECT_EQ(ids(tool().fromVehicle(vehicle, 7.2)), "upper") << "within the radius of park-and-go";
}

TEST_F(TwoWayRoad, PutsAPoseOnTheLaneThatItNames) {
  builder.lane("other", {0, 0.1}, {100, 0.1});
  const auto on = [this](const char* lane) { return ids(tool().fromPose({30, 0.05}, {}, "end_pose", {{}, lane})); };
  EXPECT_EQ(on("other"), "other");
  EXPECT_EQ(on("south"), "south");
  EXPECT_EQ(on("north"), "north") << "it lies near enough";
  EXPECT_THAT_REFUSED(tool().fromPose({30, 20.0}, {}, "end_pose", {{}, "south"}), OffMap,
                      "is 20.00 m from its lane south; the limit is 10.00 m (~max_goal_distance)");
  EXPECT_THAT_REFUSED(tool().fromPose({30, 0}, {}, "end_pose", {{}, "sooth"}), InvalidRequest,
                      "names lane 'sooth', which the map does not have; did you mean");
  EXPECT_THAT_REFUSED(tool().fromPose({30, 0}, {}, "end_pose", {{}, "path"}), InvalidRequest, "not for driving");
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
  EXPECT_THAT_REFUSED(tool().fromParkingSpace("P_1", nullptr), InvalidRequest, "; did you mean 'P1'?");
}

TEST_F(TwoWayRoad, RefusesParametersOutOfRange) {
  params.snap_distance = -1.0;
  EXPECT_THAT_REFUSED(params.validate(), InvalidParameter, "snap_distance is -1");
  EXPECT_NO_THROW(LaneWayParams().validate());
}

}  // namespace
}  // namespace external_command
