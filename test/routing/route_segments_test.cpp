// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/routing_world.h"

namespace external_command {
namespace {

///   left1 ----> left2 ----> left3
///   mid1 -----> mid2 -----> mid3 ----> out     three sections of 100 m, then one lane goes on
///   right1 ---> right2 ---> right3
class Motorway : public RoutingWorld {
 protected:
  Motorway() {
    for (const char* i : {"1", "2", "3"}) {
      const double x = 100.0 * (*i - '1');
      const std::string left = std::string("left") + i, mid = std::string("mid") + i, right = std::string("right") + i;
      builder.lane(left, {x, 2 * MapBuilder::kLaneWidth}, {x + 100, 2 * MapBuilder::kLaneWidth})
          .lane(mid, {x, MapBuilder::kLaneWidth}, {x + 100, MapBuilder::kLaneWidth});
      builder.lane(right, {x, 0}, {x + 100, 0})
          .beside({left, mid, right})
          .road(std::string("road") + i, {left, mid, right});
    }
    builder.follow({"left1", "left2", "left3"}).follow({"right1", "right2", "right3"});
    builder.lane("out", {300, MapBuilder::kLaneWidth}, {400, MapBuilder::kLaneWidth})
        .follow({"mid1", "mid2", "mid3", "out"});
  }

  std::string segments(const Route& route) { return drawn(toSegments(map(), route), map()); }

  /// What driving the passages that lead on adds up to.
  double lengthOfExits(const Route& route) {
    double length = 0.0;
    for (const RouteSegment& segment : toSegments(map(), route)) {
      for (const RoutePassage& passage : segment.passages) {
        if (!passage.can_exit) continue;
        for (const LaneRange& lane : passage.lanes) length += lane.to_s - lane.from_s;
      }
    }
    return length;
  }
};

TEST_F(Motorway, HasASegmentPerLaneWhereNoLaneIsChanged) {
  const Route route = drive({"mid1", 10}, {"out", 50});
  EXPECT_EQ(segments(route), "{mid1*} {mid2*} {mid3*} {out*}");
  const auto list = toSegments(map(), route);
  EXPECT_EQ(list[0].id, "road1");
  EXPECT_EQ(list[3].id, "out") << "no road names it";
  EXPECT_EQ(list[0].passages[0].lanes[0].from_s, 10.0);
  EXPECT_EQ(list[3].passages[0].lanes[0].to_s, 50.0);
}

TEST_F(Motorway, PutsThePassagesOfAChangeSideBySideFromRightToLeft) {
  EXPECT_EQ(segments(drive({"mid1", 10}, {"left1", 90})), "{mid1|left1*}");
  EXPECT_EQ(segments(drive({"mid1", 10}, {"right1", 90})), "{right1*|mid1}");
  const Route route = drive({"mid1", 10}, {"right1", 90});
  const auto list = toSegments(map(), route);
  EXPECT_EQ(list[0].passages[1].change, LaneChange::kRight);
  EXPECT_EQ(list[0].passages[0].change, LaneChange::kNone);
  EXPECT_EQ(list[0].passages[0].lanes[0].from_s, 10.0);
}

TEST_F(Motorway, NamesEveryLaneThatAChangeCanBeDoneOn) {
  EXPECT_EQ(segments(drive({"right1", 50}, {"out", 50})), "{right1 right2|mid1 mid2*} {mid3*} {out*}");
}

TEST_F(Motorway, HasASegmentForEachOfTwoChangesInARow) {
  const Route route = drive({"right1", 0}, {"left1", 90});
  EXPECT_EQ(segments(route), "{right1|mid1*} {mid1|left1*}");
  const auto list = toSegments(map(), route);
  EXPECT_NEAR(list[0].passages[1].lanes[0].to_s, 45.0, 1e-6);
  EXPECT_NEAR(list[1].passages[0].lanes[0].from_s, 45.0, 1e-6);
}

TEST_F(Motorway, HasASegmentForAChangeThereAndOneForTheChangeBack) {
  const Route route = drive({"mid1", 0}, {}, {"out", 10}, {{"mid1", 60, 65}, {"right1", 0, 100}});
  EXPECT_EQ(segments(route), "{mid1|left1*} {mid1 mid2*|left1 left2} {mid3*} {out*}");
}

TEST_F(Motorway, LeadsThroughItsPassagesInTheRoutesDistance) {
  for (const auto& [from, to] : {std::pair("right1", "left3"), {"left1", "out"}, {"mid1", "right2"}}) {
    const Route route = drive({from, 20}, {to, 80});
    EXPECT_NEAR(lengthOfExits(route), route.distance, 1e-6) << from << " " << to;
  }
}

TEST_F(Motorway, HasASegmentForARouteThatIsAPoint) {
  EXPECT_EQ(segments(drive({"mid1", 10}, {"mid1", 10})), "{mid1*}");
}

}  // namespace
}  // namespace external_command
