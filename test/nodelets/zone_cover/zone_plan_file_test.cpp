// SPDX-License-Identifier: Apache-2.0
#include "nodelets/zone_cover/zone_plan_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "external_command/core/error.h"
#include "nodelets/zone_cover/zone_text.h"
#include "support/zone_plans.h"

namespace external_command {
namespace {

namespace fs = std::filesystem;

CoverageArea yard(double width = 40.0) { return {Polygon({{0, 0}, {width, 0}, {width, 30}, {0, 30}}, "yard"), {}}; }

ZoneKey keyOf(const std::string& vehicle, const std::string& label = "", const CoverageArea& area = yard(),
              const CoverageParams& params = {}) {
  return zoneKey(vehicle, label, area, params, VehicleParams());
}

TEST(ZoneKey, IsTheSameInEveryBuild) {
  EXPECT_EQ(keyOf("/courtyard", "yard 1").name, "courtyard-yard_1");
  EXPECT_EQ(keyOf("/", "").name, "root-polygon");
  EXPECT_EQ(keyOf("/courtyard", "yard 1").digest, 4099563127402775185ull);
}

TEST(ZoneKey, DiffersWithVehicleAreaAndParameters) {
  CoverageParams wider;
  wider.swath_width = 2.5;
  CoverageArea with_hole = yard();
  with_hole.holes.push_back(Polygon({{5, 5}, {6, 5}, {6, 6}}, "hole"));
  std::set<std::uint64_t> digests;
  for (const ZoneKey& key :
       {keyOf("/first"), keyOf("/second"), keyOf("/first", "a"), keyOf("/first", "", yard(40.5)),
        keyOf("/first", "", yard(), wider), keyOf("/first", "", with_hole), keyOf("/a/b"), keyOf("/a_b")}) {
    digests.insert(key.digest);
  }
  EXPECT_EQ(digests.size(), 8u);
}

TEST(ZoneKey, ForgivesRounding) { EXPECT_EQ(keyOf("/a", "", yard(40.0)).digest, keyOf("/a", "", yard(40.001)).digest); }

TEST(ZoneFolder, IsInTheFolderOfRosUnlessItIsGiven) {
  setenv("HOME", "/home/me", 1);
  unsetenv("ROS_HOME");
  EXPECT_EQ(zoneFolder(""), "/home/me/.ros/external_command");
  EXPECT_EQ(zoneFolder("~/zones"), "/home/me/zones");
  EXPECT_EQ(zoneFolder("/var/zones"), "/var/zones");
  EXPECT_EQ(zoneFolder("~zones"), "~zones") << "a name like any other";
  setenv("ROS_HOME", "/var/ros", 1);
  EXPECT_EQ(zoneFolder(""), "/var/ros/external_command");
  EXPECT_EQ(zoneFolder("~/zones"), "/home/me/zones");
}

class ZonePlanFileTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& content) const {
    fs::create_directories(folder_);
    std::ofstream(file_.path(), std::ios::binary) << content;
  }

  std::string content(const CoverageProgress& progress) const {
    const std::string head = zoneHead(file_.digest(), progress), lines = zoneLines(progress.lines);
    return head + lines + zoneChecksum(head, lines);
  }

  const std::string folder_ = "/tmp/external_command_zone_plan_file_test_" + std::to_string(getpid());
  const ZonePlanFile file_{folder_, keyOf("/courtyard", "yard")};
};

TEST_F(ZonePlanFileTest, IsNamedForVehicleAndArea) {
  EXPECT_EQ(file_.path().rfind(folder_ + "/courtyard-yard-", 0), 0u) << file_.path();
}

TEST_F(ZonePlanFileTest, KnowsNothingOfAZoneThatWasNeverBegun) { EXPECT_FALSE(file_.read()); }

TEST_F(ZonePlanFileTest, ReadsWhatIsKept) {
  write(content(begunPlan()));
  const auto read = file_.read();
  ASSERT_TRUE(read);
  EXPECT_TRUE(areEqual(*read, begunPlan()));
}

TEST_F(ZonePlanFileTest, RefusesADamagedFileAndKeepsItAside) {
  write(content(begunPlan()) + "x");
  EXPECT_THROW(file_.read(), InvalidRequest);
  EXPECT_FALSE(file_.isSetAside());
  file_.setAside();
  EXPECT_TRUE(file_.isSetAside());
  EXPECT_FALSE(file_.read()) << "it is there no more";
}

TEST_F(ZonePlanFileTest, RefusesAFileOfAnotherZone) {
  const ZonePlanFile other(folder_, keyOf("/courtyard", "yard", yard(50.0)));
  fs::create_directories(folder_);
  std::ofstream(other.path()) << content(begunPlan());
  EXPECT_THROW(other.read(), InvalidRequest);
}

TEST_F(ZonePlanFileTest, RefusesWhatIsNoFile) {
  fs::create_directories(file_.path());
  EXPECT_THROW(file_.read(), InternalError);
}

TEST_F(ZonePlanFileTest, RemovesWhatAKilledProcessHasLeft) {
  write("");
  const std::string left = file_.path() + ".999999999-1.new",
                    own = file_.path() + "." + std::to_string(getpid()) + "-1.new",
                    in_use = file_.path() + "." + std::to_string(getppid()) + "-1.new",
                    of_another = folder_ + "/second-yard-0.zone.999999999-1.new";
  for (const std::string& path : {left, own, in_use, of_another}) std::ofstream(path) << "x";
  removeLeftovers(folder_, "/courtyard");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_FALSE(fs::exists(own)) << "a process before this one had the same number";
  EXPECT_TRUE(fs::exists(in_use));
  EXPECT_TRUE(fs::exists(of_another));
  EXPECT_TRUE(fs::exists(file_.path()));
  removeLeftovers(folder_ + "/missing", "/courtyard");
}

}  // namespace
}  // namespace external_command
