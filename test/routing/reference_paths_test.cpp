// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/reference_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <optional>
#include <random>
#include <thread>

#include "../../src/routing/recent_memory.h"
#include "external_command/map/map_reader.h"

namespace external_command {
namespace {

constexpr int kRoutes = 60;
constexpr unsigned kPathSeed = 20240611;

double difference(const ReferencePoint& a, const ReferencePoint& b) {
  const double place = std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
  const double bend = std::max(std::abs(angleBetween(a.heading, b.heading)), std::abs(a.kappa - b.kappa));
  return std::max({place, bend, std::abs(a.s - b.s), std::abs(a.speed - b.speed)});
}

testing::AssertionResult areTheSame(const ReferencePath& a, const ReferencePath& b) {
  if (a.path.size() != b.path.size()) {
    return testing::AssertionFailure() << a.path.size() << " points and " << b.path.size();
  }
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    const double by = difference(a.path[i], b.path[i]);
    if (by > 1e-9) return testing::AssertionFailure() << "point " << i << " differs by " << by;
  }
  if (a.tight.size() != b.tight.size() || a.left.size() != b.left.size()) {
    return testing::AssertionFailure() << "other stretches are told of";
  }
  return testing::AssertionSuccess();
}

/// Paths over a map file; skipped where that is absent.
class PathsOverAMap : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string file = GetParam();
    if (!std::ifstream(file)) GTEST_SKIP() << "no map " << file;
    map_ = readMap(file, {});
    for (LaneIndex i = 0; i < map_->lanes().size(); ++i) {
      if (map_->lane(i).isDrivable()) lanes_.push_back(i);
    }
    const Router router(map_, RouterParams());
    while (routes_.size() < kRoutes) {
      try {
        routes_.push_back(router.findRoute({{anyPlace()}, {}, {anyPlace()}, {}}, CancelToken()));
      } catch (const NoRoute&) {
      }
    }
  }

  LanePoint anyPlace() {
    const LaneIndex lane = lanes_[std::uniform_int_distribution<std::size_t>(0, lanes_.size() - 1)(random_)];
    return {lane, std::uniform_real_distribution<double>(0.0, map_->lane(lane).length())(random_)};
  }

  /// A vehicle beside the beginning of `route`.
  Pose2d besideStart(const Route& route) const {
    const Pose2d pose = map_->lane(route.steps.front().lane).center.poseAt(route.steps.front().from_s);
    return compose(pose, {0.0, 0.5, 0.1});
  }

  ReferencePath computed(const Route& route, const ReferencePathQuery& query) const {
    return referencePath(*map_, route, vehicle_, params_, query);
  }

  const VehicleParams vehicle_;
  const ReferencePathParams params_;
  std::shared_ptr<const HdMap> map_;
  std::vector<LaneIndex> lanes_;
  std::vector<Route> routes_;
  std::mt19937 random_{kPathSeed};
};

TEST_P(PathsOverAMap, AreTheSameFromMemory) {
  const ReferencePaths paths(map_, vehicle_, params_);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      const ReferencePathQuery query{i % 2 == 0 ? 0.0 : 4.0};
      EXPECT_TRUE(areTheSame(paths.find(routes_[i], query), computed(routes_[i], query))) << "route " << i;
    }
  }
  EXPECT_GT(paths.kept(), 0u);
}

TEST_P(PathsOverAMap, ShareTheMemoryOfWhoHasMapVehicleAndParametersInCommon) {
  const auto paths = ReferencePaths::acquire(map_, vehicle_, params_);
  EXPECT_EQ(ReferencePaths::acquire(map_, vehicle_, params_), paths);
  VehicleParams wider = vehicle_;
  wider.width += 0.1;
  EXPECT_NE(ReferencePaths::acquire(map_, wider, params_), paths);
  ReferencePathParams finer = params_;
  finer.spacing /= 2.0;
  EXPECT_NE(ReferencePaths::acquire(map_, vehicle_, finer), paths);
}

TEST_P(PathsOverAMap, AreTheSameFromMemoryWhereTheyBeginAtAVehicle) {
  const ReferencePaths paths(map_, vehicle_, params_);
  for (std::size_t i = 0; i < routes_.size(); ++i) {
    const ReferencePathQuery query{0.0, besideStart(routes_[i])};
    EXPECT_TRUE(areTheSame(paths.find(routes_[i], query), computed(routes_[i], query))) << "route " << i;
  }
}

TEST_P(PathsOverAMap, AreTheSameForThreadsThatAskAtOnce) {
  const ReferencePaths paths(map_, vehicle_, params_);
  std::vector<ReferencePath> expected;
  for (const Route& route : routes_) expected.push_back(computed(route, {}));
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (std::size_t i = 0; i < routes_.size(); ++i) {
        if (!areTheSame(paths.find(routes_[i], {}), expected[i])) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST_P(PathsOverAMap, AreGivenUpWhenTheyAreCancelled) {
  const ReferencePaths paths(map_, vehicle_, params_);
  const CancelSource source;
  source.cancel();
  EXPECT_THROW(paths.find(routes_.front(), {0.0, std::nullopt, source.token()}), Cancelled);
  EXPECT_TRUE(areTheSame(paths.find(routes_.front(), {}), computed(routes_.front(), {}))) << "afterwards";
}

TEST_P(PathsOverAMap, AreRefusedFromMemoryTooWhereTheyCannotBeDriven) {
  ReferencePathParams strict;
  strict.refuse_undrivable = true;
  const ReferencePaths paths(map_, vehicle_, strict);
  for (const Route& route : routes_) {
    if (computed(route, {}).tight.empty()) {
      EXPECT_NO_THROW(paths.find(route, {}));
    } else {
      EXPECT_THROW(paths.find(route, {}), NoPath);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, PathsOverAMap,
                         testing::Values(EC_SOURCE_DIR "/maps/demo_town/base_map.bin",
                                         EC_SHARED_DIR "/data/maps/town01/base_map.bin",
                                         EC_SHARED_DIR "/data/maps/town01/sim_map.bin",
                                         EC_SHARED_DIR "/data/maps/town10hd/base_map.bin",
                                         EC_SHARED_DIR "/data/maps/town10hd/sim_map.bin",
                                         EC_SHARED_DIR "/data/maps/autonomoustuff/base_map.bin"),
                         [](const auto& map) { return "Map" + std::to_string(map.index); });

using Memory = RecentMemory<int, int, std::hash<int>>;

void keep(int key, std::size_t cost, Memory* memory) { memory->keep(key, std::make_shared<const int>(10 * key), cost); }

TEST(RecentMemory, FindsWhatItKeeps) {
  Memory memory(10);
  EXPECT_EQ(memory.find(1), nullptr);
  keep(1, 4, &memory);
  ASSERT_NE(memory.find(1), nullptr);
  EXPECT_EQ(*memory.find(1), 10);
}

TEST(RecentMemory, ForgetsWhatWasNotAskedForForLongest) {
  Memory memory(10);
  keep(1, 4, &memory);
  keep(2, 4, &memory);
  memory.find(1);
  keep(3, 4, &memory);
  EXPECT_NE(memory.find(1), nullptr);
  EXPECT_EQ(memory.find(2), nullptr);
  EXPECT_NE(memory.find(3), nullptr);
  EXPECT_EQ(memory.sum(), 8u);
}

TEST(RecentMemory, StaysWithinItsBound) {
  Memory memory(100);
  for (int key = 0; key < 1000; ++key) {
    keep(key, static_cast<std::size_t>(key % 37), &memory);
    ASSERT_LE(memory.sum(), 100u);
  }
}

TEST(RecentMemory, KeepsNothingThatIsLargerThanItself) {
  Memory memory(10);
  keep(1, 4, &memory);
  keep(2, 11, &memory);
  EXPECT_EQ(memory.find(2), nullptr);
  EXPECT_NE(memory.find(1), nullptr);
}

TEST(RecentMemory, LeavesAloneWhoStillUsesWhatItForgets) {
  Memory memory(1);
  keep(1, 1, &memory);
  const auto used = memory.find(1);
  keep(2, 1, &memory);
  EXPECT_EQ(memory.find(1), nullptr);
  EXPECT_EQ(*used, 10);
}

}  // namespace
}  // namespace external_command
