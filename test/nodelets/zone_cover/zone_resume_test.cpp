// SPDX-License-Identifier: Apache-2.0
#include "nodelets/zone_cover/zone_resume.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "external_command/core/error.h"
#include "nodelets/zone_cover/zone_text.h"
#include "support/zone_plans.h"

namespace external_command {
namespace {

namespace fs = std::filesystem;

class ZoneResumeTest : public testing::Test {
 protected:
  ZoneResumeTest() { fs::create_directories(folder_); }
  ~ZoneResumeTest() override { fs::remove_all(folder_); }

  std::string content(const CoverageProgress& progress) const {
    return signedAnew(zoneHead(file_.digest(), progress) + zoneLines(progress.lines));
  }

  static std::string signedAnew(const std::string& text) { return text + zoneChecksum(text, ""); }

  void write(const std::string& text) const { std::ofstream(file_.path(), std::ios::binary) << text; }

  CoverageProgress read(bool dry_run = false) const { return readProgress(file_, zone_, {}, {}, dry_run); }

  std::string refusal(bool dry_run = false) const {
    try {
      read(dry_run);
      return "";
    } catch (const InvalidRequest& error) {
      return error.what();
    }
  }

  const std::string folder_ = "/tmp/external_command_zone_resume_test_" + std::to_string(getpid());
  const CoverageArea zone_{Polygon({{0, 0}, {40, 0}, {40, 30}, {0, 30}}, "yard"), {}};
  const ZonePlanFile file_{folder_, zoneKey("/courtyard", "yard", zone_, {}, {})};
};

TEST_F(ZoneResumeTest, ReadsWhatIsKept) {
  write(content(begunPlan()));
  EXPECT_TRUE(areEqual(read(), begunPlan()));
}

TEST_F(ZoneResumeTest, SaysThatNothingIsKept) {
  EXPECT_NE(refusal().find("no earlier run of this zone is known (" + file_.path()), std::string::npos) << refusal();
}

TEST_F(ZoneResumeTest, KeepsADamagedFileAsideButForADryRun) {
  write(content(begunPlan()) + "x");
  EXPECT_NE(refusal(true).find("is damaged: its checksum is wrong; send"), std::string::npos);
  EXPECT_TRUE(fs::exists(file_.path()));
  EXPECT_NE(refusal().find("it is kept aside as " + file_.damagedPath()), std::string::npos);
  EXPECT_FALSE(fs::exists(file_.path()));
  EXPECT_NE(refusal().find("but a damaged file, " + file_.damagedPath()), std::string::npos) << refusal();
}

TEST_F(ZoneResumeTest, RefusesWhatCannotBeTrueOfVehicleAndZone) {
  CoverageProgress progress = begunPlan();
  progress.lines[1].start.x = 5000.0;
  write(content(progress));
  EXPECT_NE(refusal().find("swath 1 leaves the area"), std::string::npos);
}

/// Each number replaced by ones that lie, the checksum made right: refused, or planned within a moment.
TEST_F(ZoneResumeTest, TakesNeitherMinutesNorGigabytesWhateverANumberSays) {
  std::string good = content(begunPlan());
  good.resize(good.rfind("checksum"));
  CoverageParams params;
  params.time_budget = 3600.0;
  const CoveragePlanner planner(VehicleParams(), params);
  std::chrono::duration<double> longest{0.0};
  for (std::size_t i = good.find("counts"); i < good.size(); ++i) {
    if (good[i] != ' ' || std::isalpha(static_cast<unsigned char>(good[i + 1]))) continue;
    const std::size_t end = good.find_first_of(" \n", i + 1);
    for (const char* lie : {"0", "-1", "0.001", "3", "100", "1e5", "1e9", "1e308", "-1e9", "4294967296", "x"}) {
      std::string bad = good;
      bad.replace(i + 1, end - i - 1, lie);
      write(signedAnew(bad));
      const auto begin = std::chrono::steady_clock::now();
      try {
        planner.plan(zone_, Pose2d{10.0, 10.0, 0.0}, read(true), {});
      } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ErrorCode::kInvalidRequest || error.code() == ErrorCode::kNoPath) << error.what();
      }
      longest = std::max<std::chrono::duration<double>>(longest, std::chrono::steady_clock::now() - begin);
    }
  }
  EXPECT_LT(longest.count(), 5.0);
}

TEST_F(ZoneResumeTest, LeavesSkippedSwathsForTheEnd) {
  CoverageProgress progress = begunPlan();
  addSkipped({2, 1, 2}, &progress);
  EXPECT_EQ(progress.skipped, (std::vector<std::size_t>{1, 2}));
  progress.sweep(0, 1000.0);
  addSkipped({0}, &progress);
  EXPECT_FALSE(progress.isSkipped(0)) << "it is done";
  try {
    addSkipped({3}, &progress);
    FAIL() << "accepted";
  } catch (const InvalidRequest& error) {
    EXPECT_NE(std::string(error.what()).find("0 to 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace external_command
