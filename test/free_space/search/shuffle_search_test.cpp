// SPDX-License-Identifier: Apache-2.0
#include "free_space/search/shuffle_search.h"

#include <gtest/gtest.h>

#include "external_command/core/path.h"
#include "search_world.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

bool isFoundIn(const SearchWorld& world, const std::function<bool()>& stop = kNeverStop) {
  return ShuffleSearch(world.scene, world.query, world.area, world.to_goal).run(stop);
}

TEST(ShuffleSearch, TurnsRoundInAStreetLittleWiderThanTheVehicleIsLong) {
  const ParkingWorld place = street(5.3);
  const SearchWorld world(place);
  ShuffleSearch search(world.scene, world.query, world.area, world.to_goal);
  ASSERT_TRUE(search.run(kNeverStop));
  const Path path = sampleArcs(place.start, search.arcs(), 0.05);
  EXPECT_TRUE(joins(path, place.start, place.goal));
  EXPECT_TRUE(isDrivable(path, place.vehicle));
  EXPECT_TRUE(staysClear(path, place.vehicle, place.region, -0.002));
  EXPECT_GT(gearChangesOf(search.arcs()), 4U);
}

TEST(ShuffleSearch, FindsNothingWhereTheBodyDoesNotFit) {
  EXPECT_FALSE(isFoundIn(SearchWorld(street(4.8))));
  EXPECT_FALSE(isFoundIn(SearchWorld(corner(2.2))));
}

TEST(ShuffleSearch, FindsNothingOnceStopped) {
  const SearchWorld world(street(5.3));
  EXPECT_FALSE(isFoundIn(world, [] { return true; }));
  for (const int looks : {10, 1'000, 20'000}) {
    int left = looks;
    isFoundIn(world, [&left] { return --left < 0; });
    EXPECT_GT(left, -50) << "it goes on for long after " << looks << " looks";
  }
}

}  // namespace
}  // namespace external_command
