// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "../benchmark/parking_case.h"
#include "external_command/free_space/free_space_planner.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

const std::string kFolder = std::string(EC_SHARED_DIR) + "/data/parking";

TEST(ParkingCases, AreAllSolvedAtACentimetre) {
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "there are no parking cases in " << kFolder;
  FreeSpaceParams params;
  params.margin = 0.01;
  params.time_budget = 10.0;
  params.improve_iterations = 1000;
  for (const std::string& file : benchmark::parkingCaseFiles({kFolder})) {
    const benchmark::ParkingCase task = benchmark::readParkingCase(file);
    const auto result = FreeSpacePlanner(task.vehicle, params).plan(task.start, {task.goal}, task.region, {});
    EXPECT_TRUE(isDrivable(result.path, task.vehicle)) << task.name;
    EXPECT_TRUE(joins(result.path, task.start, task.goal)) << task.name;
    EXPECT_TRUE(staysClear(result.path, task.vehicle, task.region, 0.008)) << task.name;
    const auto best_known = benchmark::bestKnownCosts(file);
    const auto known = best_known.find(task.name);
    const double plain_cost = result.length + 3.0 * result.gear_changes;  // what best_known.json counts
    EXPECT_LT(plain_cost, known == best_known.end() ? 1e9 : 1.5 * known->second) << task.name;
  }
}

TEST(ParkingCases, ReportAFileThatIsNone) {
  EXPECT_THROW(benchmark::readParkingCase(std::string(EC_SOURCE_DIR) + "/package.xml"), std::runtime_error);
  EXPECT_THROW(benchmark::parkingCaseFiles({"/no/such/folder"}), std::runtime_error);
}

/// The refusal of a case with these obstacles and this goal; empty where it is read.
std::string refusalOfCase(const std::string& obstacles, const std::string& goal = "[9, 0, 0]") {
  const auto file = std::filesystem::temp_directory_path() / ("case_" + std::to_string(::getpid()) + ".json");
  std::ofstream(file) << R"({"vehicle": {"wheelbase": 2.8, "width": 1.9, "front_overhang": 0.9, "rear_overhang": 0.9,
    "min_turning_radius": 5}, "start": [0, 0, 0], "bounds": [-9, -9, 30, 9], "obstacles": )"
                      << obstacles << R"(, "goal": )" << goal << "}";
  std::string refusal;
  try {
    benchmark::readParkingCase(file.string());
  } catch (const std::runtime_error& error) {
    refusal = error.what();
  }
  std::filesystem::remove(file);
  return refusal;
}

TEST(ParkingCases, AreRefusedWhereAnObstacleHasNoCornerOrOneThatIsNoPlace) {
  EXPECT_EQ(refusalOfCase("[]"), "");
  EXPECT_EQ(refusalOfCase("[[[20, 3]], [[20, 5], [22, 5]], [[0, 4], [2, 6], [2, 4], [0, 6]]]"), "");
  EXPECT_NE(refusalOfCase("[[]]").find("obstacles[0] has no corner"), std::string::npos) << refusalOfCase("[[]]");
  EXPECT_NE(refusalOfCase("[[[20, 3]], [[NaN, 0]]]"), "");
  EXPECT_NE(refusalOfCase("[]", "[9, 0]").find("goal must be 3 numbers"), std::string::npos);
}

}  // namespace
}  // namespace external_command
