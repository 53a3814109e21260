// SPDX-License-Identifier: Apache-2.0
#include "../../src/routing/line_mending.h"

#include <gtest/gtest.h>

#include "support/map_builder.h"

namespace external_command {
namespace {

using Indices = std::vector<std::size_t>;

TEST(LineMending, KeepsALineThatGoesOn) {
  EXPECT_EQ(withoutFolds({{0, 0}, {10, 0}, {20, 5}, {20, 15}}), (Indices{0, 1, 2, 3}));
  EXPECT_EQ(withoutFolds({{0, 0}, {1, 0}}), (Indices{0, 1}));
}

TEST(LineMending, LeavesOutRepeatedPointsButNotTheEnds) {
  EXPECT_EQ(withoutFolds({{0, 0}, {0, 0}, {5, 0}, {5, 0}, {9, 0}, {9, 0}}), (Indices{0, 2, 5}));
  EXPECT_EQ(withoutFolds({{0, 0}, {0, 0}}), (Indices{0, 1}));
}

TEST(LineMending, LeavesOutAFold) {
  EXPECT_EQ(withoutFolds({{0, 0}, {45, 0}, {50, 0}, {47, 0}, {52, 0}, {60, 0}}), (Indices{0, 1, 3, 4, 5}));
  EXPECT_EQ(withoutFolds({{0, 0}, {40, 0}, {50, 0}, {48, 0}, {46, 0}, {60, 0}}), (Indices{0, 1, 4, 5}));
}

TEST(LineMending, KeepsALineThatTurnsRoundForGood) {
  EXPECT_EQ(withoutFolds({{0, 0}, {50, 0}, {20, 0.1}, {0, 0.1}}), (Indices{0, 1, 2, 3}));
  EXPECT_EQ(withoutFolds({{0, 0}, {50, 0}, {50, 2}, {0, 2}}), (Indices{0, 1, 2, 3}));
}

TEST(LineMending, CutsEndsThatOverlap) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {50, 0}).lane("b", {47, 0}, {100, 0});
  const auto map = builder.build();
  std::vector<LaneRange> pieces = {{0, 0.0, 50.0}, {1, 0.0, 53.0}};
  joinEnds(*map, &pieces);
  EXPECT_NEAR(pieces[0].to_s, 47.0, 1e-9);
  EXPECT_EQ(pieces[1].from_s, 0.0);
}

TEST(LineMending, LeavesRoomForASlantBetweenEndsThatLieBesideEachOther) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {50, 0}).lane("b", {50, 1}, {100, 1}).lane("c", {51, 1}, {52, 1});
  const auto map = builder.build();
  std::vector<LaneRange> pieces = {{0, 0.0, 50.0}, {1, 0.0, 50.0}};
  joinEnds(*map, &pieces);
  EXPECT_NEAR(pieces[0].to_s, 48.0, 1e-9);
  EXPECT_NEAR(pieces[1].from_s, 2.0, 1e-9);
  pieces = {{0, 0.0, 50.0}, {2, 0.0, 1.0}};
  joinEnds(*map, &pieces);
  EXPECT_NEAR(pieces[1].from_s, 0.5, 1e-9) << "half of a lane stays";
}

TEST(LineMending, LeavesLanesThatMeetAsTheyAre) {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {50, 0}).lane("b", {50.01, 0}, {100, 0});
  const auto map = builder.build();
  std::vector<LaneRange> pieces = {{0, 0.0, 50.0}, {1, 0.0, 49.0}};
  joinEnds(*map, &pieces);
  EXPECT_EQ(pieces[0].to_s, 50.0);
  EXPECT_EQ(pieces[1].from_s, 0.0);
}

}  // namespace
}  // namespace external_command
