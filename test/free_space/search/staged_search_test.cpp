// SPDX-License-Identifier: Apache-2.0
#include "free_space/search/staged_search.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "external_command/core/path.h"
#include "free_space/search/search_box.h"
#include "search_world.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

using Outcome = TwoWaySearch::Outcome;

constexpr std::size_t kAFewMore = kFirstLookSteps + 1;  ///< enough for a proof and way poses
constexpr std::size_t kManyMore = 30'001;               ///< enough for shuffling, too

FirstPath searched(const ParkingWorld& place, std::size_t max_steps, const std::function<bool()>& stop = kNeverStop) {
  const SearchWorld world(place);
  return searchInStages(world.scene, world.query, searchArea(world.scene, world.query), max_steps, stop);
}

void expectsAPath(const FirstPath& found, const ParkingWorld& place) {
  ASSERT_EQ(found.outcome, Outcome::kFound);
  EXPECT_FALSE(found.no_way);
  const Path path = sampleArcs(place.start, found.arcs, 0.05);
  EXPECT_TRUE(joins(path, place.start, place.goal));
  EXPECT_TRUE(isDrivable(path, place.vehicle));
  EXPECT_TRUE(staysClear(path, place.vehicle, place.region, -0.002));
}

void expectsNone(const FirstPath& found, Outcome outcome) {
  EXPECT_EQ(found.outcome, outcome);
  EXPECT_TRUE(found.arcs.empty());
}

/// Walls across a road, `count` of them 7 m apart, with gaps by turns at its left and at its right side.
ParkingWorld gates(int count) {
  const double width = 12.0, gap = 4.0, apart = 7.0, length = apart * (count + 1);
  ParkingWorld place{tractor(), {2.0, 0.0, 0.0}, {length - 5.0, 0.0, 0.0}, Region()};
  Region::Parts parts;
  parts.drivable = box({0.5 * length, 0.0}, length, width);
  for (int i = 1; i <= count; ++i) {
    parts.non_drivable.push_back(box({i * apart, (i % 2 == 0 ? 0.5 : -0.5) * gap}, 0.3, width - gap));
  }
  place.region = Region(std::move(parts));
  return place;
}

TEST(SearchInStages, FindsMostPathsAtTheFirstLook) {
  for (const ParkingWorld& place : {parallelSlot(1.5), bay(0.6), twoYards(1.0)}) {
    expectsAPath(searched(place, kFirstLookSteps), place);
  }
}

TEST(SearchInStages, FindsALongWayOverWayPosesOnceTheFirstLookWasInVain) {
  const ParkingWorld place = gates(15);
  expectsNone(searched(place, kFirstLookSteps), Outcome::kOutOfSteps);
  expectsAPath(searched(place, kAFewMore), place);
}

TEST(SearchInStages, ShufflesBetweenTheEndsOnceTheSecondLookWasInVain) {
  const ParkingWorld place = street(5.3);
  expectsNone(searched(place, kManyMore - 1), Outcome::kOutOfSteps);
  expectsAPath(searched(place, kManyMore), place);
}

TEST(SearchInStages, ProvesThatAGateIsTooNarrowOnceTheFirstLookWasInVain) {
  const ParkingWorld place = twoYards(-0.05);
  const FirstPath at_first = searched(place, kFirstLookSteps);
  expectsNone(at_first, Outcome::kOutOfSteps);
  EXPECT_FALSE(at_first.no_way);
  const FirstPath later = searched(place, kAFewMore);
  expectsNone(later, Outcome::kNone);
  EXPECT_TRUE(later.no_way);
}

TEST(SearchInStages, EndsInEachStageOnceStopped) {
  for (const ParkingWorld& place : {gates(15), street(5.3), twoYards(-0.05)}) {
    expectsNone(searched(place, kManyMore, [] { return true; }), Outcome::kStopped);
    for (const int looks : {10, 1'000, 5'000, 32'000}) {
      int left = looks;
      searched(place, kManyMore, [&left] { return --left < 0; });
      EXPECT_GT(left, -50) << "it goes on for long after " << looks << " looks";
    }
  }
}

}  // namespace
}  // namespace external_command
