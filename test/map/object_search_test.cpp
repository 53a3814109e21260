// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/object_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "external_command/core/error.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

/// Two roads of two lanes each, one behind the other along x; two parking spaces right of the first, an area to its
/// left.
class Objects : public testing::Test {
 protected:
  Objects() {
    MapBuilder builder;
    builder.lane("l1", {0, 3.5}, {100, 3.5}).lane("l2", {0, 0}, {100, 0}).lane("l3", {100, 3.5}, {200, 3.5});
    builder.lane("l4", {100, 0}, {200, 0}).follow({"l1", "l3"}).follow({"l2", "l4"});
    builder.road("west", {"l1", "l2"}).road("east", {"l3", "l4"});
    builder.parkingSpace("p1", {20, -6, M_PI / 2}, 5.0, 2.5, {"l2", "l1"});
    builder.parkingSpace("p2", {80, -6, M_PI / 2}, 5.0, 2.5);
    builder.area("yard", {{0, 20}, {30, 20}, {30, 40}, {0, 40}});
    map_ = builder.build();
  }

  FoundObjects find(const ObjectQuery& query) const { return findObjects(*map_, query); }

  static std::vector<std::string> idsOf(const FoundObjects& found) {
    std::vector<std::string> ids;
    for (const FoundObject& object : found.objects) ids.push_back(object.id);
    return ids;
  }

  static std::string whyNot(const std::function<void()>& search) {
    try {
      search();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  using Ids = std::vector<std::string>;
  std::shared_ptr<const HdMap> map_;
};

TEST_F(Objects, AreListedInTheOrderOfTheirIds) {
  const FoundObjects found = find({});
  EXPECT_EQ(idsOf(found), (Ids{"east", "l1", "l2", "l3", "l4", "p1", "p2", "west", "yard"}));
  EXPECT_EQ(found.total, 9u);
}

TEST_F(Objects, AreOfTheKindThatIsAskedFor) {
  EXPECT_EQ(idsOf(find({MapObjectKind::kLane, "", {}, {}, 100})), (Ids{"l1", "l2", "l3", "l4"}));
  EXPECT_EQ(idsOf(find({MapObjectKind::kRoad, "", {}, {}, 100})), (Ids{"east", "west"}));
  EXPECT_EQ(idsOf(find({MapObjectKind::kParkingSpace, "", {}, {}, 100})), (Ids{"p1", "p2"}));
  EXPECT_EQ(idsOf(find({MapObjectKind::kArea, "", {}, {}, 100})), (Ids{"yard"}));
}

TEST_F(Objects, AreNoMoreThanIsAskedForButAllAreCounted) {
  const FoundObjects found = find({MapObjectKind::kLane, "", {}, {}, 2});
  EXPECT_EQ(idsOf(found), (Ids{"l1", "l2"}));
  EXPECT_EQ(found.total, 4u);
  const FoundObjects near = find({MapObjectKind::kLane, "", Point2d(150, -1), {}, 1});
  EXPECT_EQ(idsOf(near), (Ids{"l4"}));
  EXPECT_EQ(near.total, 4u);
}

TEST_F(Objects, NearAPointComeTheNearestFirstHoweverFarTheyAre) {
  for (const double far : {0.0, 1e4, 1e6}) {
    const FoundObjects found = find({{}, "", Point2d(20 - far, -6), {}, 100});
    EXPECT_EQ(found.objects.size(), 9u) << far;
    for (std::size_t i = 1; i < found.objects.size(); ++i) {
      EXPECT_LE(found.objects[i - 1].distance, found.objects[i].distance);
    }
  }
  EXPECT_EQ(idsOf(find({{}, "", Point2d(20, -6), {}, 3})), (Ids{"p1", "l2", "west"}));
}

TEST_F(Objects, BeyondTheRadiusAreNotFound) {
  const FoundObjects found = find({{}, "", Point2d(20, -6), 7.0, 100});
  EXPECT_EQ(idsOf(found), (Ids{"p1", "l2", "west"}));
  EXPECT_EQ(found.total, 3u);
  EXPECT_TRUE(find({{}, "", Point2d(20, -600), 7.0, 100}).objects.empty());
  EXPECT_TRUE(find({MapObjectKind::kArea, "yard", Point2d(20, -6), 7.0, 100}).objects.empty())
      << "it is known, but far";
}

TEST_F(Objects, TellOfALaneTheNearestPointOrTheMiddle) {
  const FoundObject near = find({MapObjectKind::kLane, "l2", Point2d(30, -2), {}, 100}).objects.at(0);
  EXPECT_NEAR(near.pose.x, 30.0, 1e-9);
  EXPECT_NEAR(near.pose.y, 0.0, 1e-9);
  EXPECT_NEAR(near.pose.heading, 0.0, 1e-9);
  EXPECT_NEAR(near.distance, 2.0, 1e-9);
  EXPECT_NEAR(near.length, 100.0, 1e-9);
  EXPECT_NEAR(near.width, 3.5, 1e-9);
  EXPECT_NEAR(find({MapObjectKind::kLane, "l2", {}, {}, 100}).objects.at(0).pose.x, 50.0, 1e-9);
}

TEST_F(Objects, TellOfARoadItsLanes) {
  const FoundObject road = find({MapObjectKind::kRoad, "west", Point2d(30, 5), {}, 100}).objects.at(0);
  EXPECT_EQ(road.lane_ids, (Ids{"l1", "l2"}));
  EXPECT_NEAR(road.distance, 1.5, 1e-9);
  EXPECT_NEAR(road.pose.y, 3.5, 1e-9);
}

TEST_F(Objects, TellOfAParkingSpaceItsMiddleSizeAndLanes) {
  const FoundObject space = find({MapObjectKind::kParkingSpace, "p1", Point2d(20, 1.5), {}, 100}).objects.at(0);
  EXPECT_NEAR(space.pose.x, 20.0, 1e-6);
  EXPECT_NEAR(space.pose.y, -6.0, 1e-6);
  EXPECT_NEAR(space.pose.heading, M_PI / 2, 1e-6);
  EXPECT_NEAR(space.length, 5.0, 1e-6);
  EXPECT_NEAR(space.width, 2.5, 1e-6);
  EXPECT_NEAR(space.distance, 5.0, 1e-6) << "to its border";
  EXPECT_EQ(space.lane_ids.size(), 2u);
  EXPECT_EQ(space.polygon->points().size(), 4u);
  EXPECT_EQ(find({MapObjectKind::kParkingSpace, "p1", Point2d(20, -5), {}, 100}).objects.at(0).distance, 0.0);
}

TEST_F(Objects, TellOfAnAreaItsMiddleAndOutline) {
  const FoundObject area = find({{}, "yard", {}, {}, 100}).objects.at(0);
  EXPECT_EQ(area.kind, MapObjectKind::kArea);
  EXPECT_NEAR(area.pose.x, 15.0, 1e-6);
  EXPECT_NEAR(area.pose.y, 30.0, 1e-6);
  EXPECT_FALSE(area.has_heading);
  EXPECT_EQ(area.polygon->points().size(), 4u);
}

TEST_F(Objects, AreAskedForByAnIdLikeTheirs) {
  EXPECT_THROW(find({MapObjectKind::kParkingSpace, "p11", {}, {}, 100}), UnknownId);
  const std::string why = whyNot([&] { find({MapObjectKind::kArea, "yrad", {}, {}, 100}); });
  EXPECT_NE(why.find("'yard'"), std::string::npos) << why;
  EXPECT_NE(why.find("no area"), std::string::npos) << why;
  EXPECT_THROW(find({MapObjectKind::kLane, "yard", {}, {}, 100}), UnknownId) << "it is no lane";
  EXPECT_THROW(find({{}, "nothing like it", Point2d(0, 0), 10.0, 100}), UnknownId);
}

TEST_F(Objects, AreNotLookedForAroundWhatIsNoPoint) {
  EXPECT_THROW(find({{}, "", Point2d(std::nan(""), 0), {}, 100}), InvalidRequest);
  EXPECT_THROW(find({{}, "", Point2d(0, 0), -1.0, 100}), InvalidRequest);
  EXPECT_THROW(find({{}, "", Point2d(0, 0), std::nan(""), 100}), InvalidRequest);
}

}  // namespace
}  // namespace external_command
