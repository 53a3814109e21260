// SPDX-License-Identifier: Apache-2.0
// Maps that a router takes, but that nobody would draw: they must take neither minutes nor gigabytes, nor end the
// process.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "external_command/core/text.h"
#include "external_command/routing/reference_paths.h"
#include "support/routing_world.h"

namespace external_command {
namespace {

class HostileMap : public RoutingWorld {
 protected:
  static long mostMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
  }

  /// Of this process, on all threads [s].
  static double secondsOfWork() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  }

  /// Routes, paths and lists of lanes fit into this [MB].
  static constexpr long kMost = 300;

  const long before_ = mostMemory();
};

TEST_F(HostileMap, ChangesBetweenLanesThatLieOnEachOther) {
  builder.lane("a", {0, 0}, {100, 0}).lane("b", {0, 0}, {100, 0}).beside({"b", "a"});
  builder["a"].left.types = {{0.0, BoundaryType::kSolidWhite}, {50.0, BoundaryType::kDottedWhite}};
  const Route route = router().findRoute({{point("a", 0)}, {}, {point("b", 50)}, {}}, CancelToken());
  for (const RouteSegment& segment : toSegments(map(), route)) {
    for (const RoutePassage& passage : segment.passages) EXPECT_FALSE(passage.lanes.empty());
  }
}

/// Each piece twice, linked to both that follow and beside both of the other row.
TEST_F(HostileMap, FollowsAChangeOverManyShortPiecesOnceForEachPair) {
  constexpr int kPieces = 40;
  for (int i = 0; i < kPieces; ++i) {
    for (const auto& [row, y] : {std::pair("o", 0.0), std::pair("n", MapBuilder::kLaneWidth)}) {
      for (const char* copy : {"a", "b"}) builder.lane(text(row, copy, i), {1.0 * i, y}, {i + 1.0, y});
    }
    for (const char* old_copy : {"a", "b"}) {
      for (const char* new_copy : {"a", "b"}) builder.beside({text("n", new_copy, i), text("o", old_copy, i)});
    }
    for (const char* row : {"o", "n"}) {
      for (const char* from : {"a", "b"}) {
        for (const char* to : {"a", "b"}) {
          if (i > 0) builder.follow({text(row, from, i - 1), text(row, to, i)});
        }
      }
    }
  }
  EXPECT_EQ(drive({"oa0", 0.0}, {"oa39", 0.5}).steps.size(), static_cast<std::size_t>(kPieces));
  EXPECT_NO_THROW(drive({"oa0", 0.0}, {"na39", 0.5}));
  EXPECT_LT(mostMemory() - before_, kMost);
}

TEST_F(HostileMap, LooksBehindAStartAtEachOfManyTinyLanesOnce) {
  constexpr int kLanes = 60;
  builder.lane("t", {0, 0}, {100, 0});
  for (int i = 0; i < kLanes; ++i) builder.lane(text("c", i), {100, 0}, {100.005, 0});
  for (int i = 0; i < kLanes; ++i) {
    builder.follow({"t", text("c", i)});
    for (int k = 0; k < kLanes; ++k) builder.follow({text("c", i), text("c", k)});
  }
  EXPECT_NO_THROW(drive({"t", 10.0}, {"t", 99.8}));
  EXPECT_THAT_REFUSED(drive({"c0", 0.0}, {"t", 50.0}), NoRoute, "");
}

TEST_F(HostileMap, LooksAtNoMoreOfAnEndlessLaneThanIsDriven) {
  std::vector<Point2d> points;
  for (int i = 0; i < 2000; ++i) points.emplace_back(i % 2 == 0 ? 0.0 : 9900.0, 0.01 * i);
  builder.lane("l", points);
  const Route route = drive({"l", 0.0}, {"l", 100.0});
  const auto shared = std::shared_ptr<const HdMap>(&map(), [](const HdMap*) {});
  const ReferencePaths paths(shared, VehicleParams(), ReferencePathParams());
  EXPECT_NEAR(paths.find(route, {}).path.back().s, 100.0, 1.0);
  EXPECT_LT(mostMemory() - before_, kMost);
}

TEST_F(HostileMap, LooksForMissingNeighboursNoLongerWhereAllLanesLieOnEachOther) {
  constexpr int kLanes = 6000;
  for (int i = 0; i < kLanes; ++i) builder.lane(text("l", i), {{0, 0}, {100, 0}});
  const double before = secondsOfWork();
  EXPECT_EQ(map().lanes().size(), static_cast<std::size_t>(kLanes));
  EXPECT_LT(secondsOfWork() - before, 8.0);
}

TEST_F(HostileMap, TakesTheHeadingOfALaneOfNoLengthFromOneThatHasOne) {
  builder.lane("spoilt", {{0, 0}, {std::nan(""), std::nan("")}})
      .lane("short", {{0, -500}, {0.001, -500}, {0.0005, -500}});
  builder.lane("p", {{100, 0}, {100, 0}}).lane("next", {100, 0}, {200, 0});
  builder.follow({"spoilt", "p", "next"}).follow({"short", "p"});
  const Lane& lane = map().lane(laneIndex(map(), "p"));
  EXPECT_NEAR(lane.center.headingAt(0.0), 0.0, 1e-9);
}

}  // namespace
}  // namespace external_command
