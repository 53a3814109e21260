// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/black_list.h"

#include <gtest/gtest.h>

#include "support/routing_world.h"

namespace external_command {
namespace {

class BlackList : public testing::Test {
 protected:
  BlackList() {
    MapBuilder builder;
    builder.lane("a", {0, 0}, {100, 0}).lane("b", {100, 0}, {150, 0}).lane("c", {150, 0}, {200, 0});
    builder.road("main", {"b", "c"});
    map = builder.build();
  }

  std::shared_ptr<const HdMap> map;
};

TEST_F(BlackList, TakesPartsOfLanesAndWholeOnes) {
  const auto ranges = blackList(*map, {{"a", 10, 20}, {"b", 0, 0}}, {});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].from_s, 10.0);
  EXPECT_EQ(ranges[0].to_s, 20.0);
  EXPECT_EQ(ranges[1].from_s, 0.0);
  EXPECT_NEAR(ranges[1].to_s, 50.0, 1e-9);
}

TEST_F(BlackList, TakesAPartThatGoesOnBeyondTheLaneToItsEnd) {
  const auto ranges = blackList(*map, {{"a", 90, 100.2}, {"b", 0, 1e6}}, {});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[0].to_s, 100.0, 1e-9);
  EXPECT_NEAR(ranges[1].to_s, 50.0, 1e-9);
}

TEST_F(BlackList, TakesABeginningThatIsOffByRounding) {
  EXPECT_EQ(blackList(*map, {{"a", -1e-6, 10}}, {}).front().from_s, 0.0);
}

TEST_F(BlackList, TakesEveryLaneOfARoad) {
  const auto ranges = blackList(*map, {}, {"main"});
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[0].to_s, 50.0, 1e-9);
}

TEST_F(BlackList, RefusesWhatTheMapDoesNotHave) {
  EXPECT_THAT_REFUSED(blackList(*map, {{"a", 0, 0}, {"x", 0, 0}}, {}), InvalidRequest, "blacklisted_lane[1]");
  EXPECT_THAT_REFUSED(blackList(*map, {}, {"side"}), InvalidRequest, "blacklisted_road[0] names road 'side'");
}

TEST_F(BlackList, RefusesPartsThatAreNone) {
  for (const BlackListedLane& part : {BlackListedLane{"a", 20, 10},
                                      {"a", 101, 110},
                                      {"a", -9, -1},
                                      {"a", -10, 40},
                                      {"a", 30, 30},
                                      {"a", 100, 100},
                                      {"a", NAN, 5},
                                      {"a", 5, NAN},
                                      {"a", INFINITY, INFINITY}}) {
    EXPECT_THAT_REFUSED(blackList(*map, {part}, {}), InvalidRequest, "blacklisted_lane[0] goes from s ");
  }
}

}  // namespace
}  // namespace external_command
