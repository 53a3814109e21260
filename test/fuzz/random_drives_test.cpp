// SPDX-License-Identifier: Apache-2.0
#include "random_drives.h"

#include <gtest/gtest.h>

#include "support/map_builder.h"

namespace external_command {
namespace {

/// Three lanes round, beside a fourth, and a parking space.
MapBuilder roundWithASpace() {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {100, 0})
      .lane("b", {{100, 0}, {120, 30}, {50, 60}})
      .lane("c", {{50, 60}, {-20, 30}, {0, 0}});
  builder.lane("d", {0, 3.5}, {100, 3.5}).beside({"d", "a"}).follow({"a", "b", "c", "a"}).follow({"d", "b"});
  builder.parkingSpace("p", {50, -6, M_PI / 2}, 5, 2.5, {"a"});
  return builder;
}

TEST(RandomDrives, MakePathsInAMapThatIsRight) {
  std::mt19937 random(1);
  std::size_t paths = 0;
  for (int i = 0; i < 20; ++i) paths += driveAbout(roundWithASpace().build(), &random);
  EXPECT_GT(paths, 20u);
}

TEST(RandomDrives, TakeRefusalsWhereNothingIsDrivenOn) {
  MapBuilder builder = roundWithASpace();
  for (LaneData& lane : builder.data().lanes) lane.type = LaneType::kSidewalk;
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(driveAbout(builder.build(), &random), 0u);
}

}  // namespace
}  // namespace external_command
