// SPDX-License-Identifier: Apache-2.0
// Maps that other people made. Skipped where they do not lie beside the checkout.
#include <gtest/gtest.h>

#include <algorithm>

#include "external_command/map/map_reader.h"
#include "map/map_files.h"

namespace external_command {
namespace {

class RealMaps : public ::testing::Test {
 protected:
  void SetUp() override {
    if (sharedMaps().size() < 3) GTEST_SKIP() << "no maps in " << EC_SHARED_DIR << "/data/maps";
  }

  static std::string path(const std::string& name) { return std::string(EC_SHARED_DIR) + "/data/maps/" + name; }

  static std::size_t drivableLanes(const HdMap& map) {
    return static_cast<std::size_t>(
        std::count_if(map.lanes().begin(), map.lanes().end(), [](const Lane& lane) { return lane.isDrivable(); }));
  }
};

TEST_F(RealMaps, LoadWithAllTheirLanes) {
  const auto town01 = readMap(path("town01/base_map.bin"), {});
  EXPECT_EQ(town01->lanes().size(), 300u);
  EXPECT_EQ(drivableLanes(*town01), 124u);
  const auto town10 = readMap(path("town10hd/base_map.bin"), {});
  EXPECT_EQ(town10->lanes().size(), 401u);
  EXPECT_EQ(drivableLanes(*town10), 168u);
  const auto lot = readMap(path("autonomoustuff/base_map.bin"), {});
  EXPECT_EQ(lot->lanes().size(), 65u);
  EXPECT_EQ(lot->parkingSpaces().size(), 236u);
}

TEST_F(RealMaps, ReadTheSameFromTextAndBinary) {
  for (const char* town : {"town01", "town10hd"}) {
    const std::string folder = path(town);
    EXPECT_TRUE(sameData(readMapData(folder + "/sim_map.bin"), readMapData(folder + "/sim_map.txt"))) << town;
  }
}

TEST_F(RealMaps, AreThinnedToTheSameTopology) {
  for (const char* town : {"town01", "town10hd"}) {
    const auto base = readMap(path(town) + "/base_map.bin", {}), sim = readMap(path(town) + "/sim_map.bin", {});
    ASSERT_EQ(base->lanes().size(), sim->lanes().size());
    for (const Lane& lane : base->lanes()) {
      const Lane& thinned = sim->lane(*sim->findLane(lane.id));
      EXPECT_EQ(lane.successors.size(), thinned.successors.size());
      EXPECT_EQ(lane.left_forward.size(), thinned.left_forward.size());
      EXPECT_NEAR(lane.length(), thinned.length(), 1.0);
    }
  }
}

TEST_F(RealMaps, LinkDrivingLanesEndToStart) {
  for (const std::string& file : sharedMaps()) {
    const auto map = readMap(file, {});
    for (const Lane& lane : map->lanes()) {
      for (const LaneIndex next : lane.successors) {
        if (!lane.isDrivable()) continue;
        const Point2d gap = map->lane(next).center.points().front() - lane.center.points().back();
        EXPECT_LT(gap.norm(), 0.5) << lane.id << " to " << map->lane(next).id << " in " << file;
      }
    }
  }
}

TEST_F(RealMaps, NameTheJunctionsOfTheirLanes) {
  for (const std::string& file : sharedMaps()) {
    const auto map = readMap(file, {});
    EXPECT_GT(std::count_if(map->lanes().begin(), map->lanes().end(),
                            [](const Lane& lane) { return lane.isDrivable() && !lane.junction_id.empty(); }),
              20)
        << file;
  }
}

TEST_F(RealMaps, HaveLanesOfPlausibleWidth) {
  for (const std::string& file : sharedMaps()) {
    const auto map = readMap(file, {});
    for (const Lane& lane : map->lanes()) {
      if (!lane.isDrivable()) continue;
      EXPECT_GT(lane.widthAt(lane.length() / 2.0), 1.5) << lane.id << " in " << file;
      EXPECT_LT(lane.widthAt(lane.length() / 2.0), 12.0) << lane.id << " in " << file;
    }
  }
}

TEST_F(RealMaps, HaveParkingSpacesThatPointAwayFromTheirLanes) {
  const auto map = readMap(path("autonomoustuff/base_map.bin"), {});
  for (const ParkingSpace& space : map->parkingSpaces()) {
    EXPECT_FALSE(space.lanes.empty()) << space.id;
    Point2d middle = Point2d::Zero();
    for (const Point2d& corner : space.polygon.points()) middle += corner / 4.0;
    const auto lane = map->nearestLane(middle, {});
    const Point2d away = middle - map->lane(lane->lane).center.pointAt(lane->frenet.s);
    EXPECT_GT(away.normalized().dot(unitVector(space.heading)), 0.7) << space.id;
  }
}

TEST_F(RealMaps, LieAroundZeroWithAnAutomaticOrigin) {
  const auto map = readMap(path("autonomoustuff/base_map.bin"), {MapOrigin::Kind::kAuto, {}});
  EXPECT_GT(map->origin().norm(), 1e6);
  EXPECT_LT(map->box().min.norm(), 1000.0);
  EXPECT_LT(map->box().max.norm(), 1000.0);
}

}  // namespace
}  // namespace external_command
