// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../benchmark/made_cases.h"
#include "external_command/core/error.h"
#include "quick_plans.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

using benchmark::ParkingCase;

FreeSpaceParams firstPathParams() {
  FreeSpaceParams params = quickParams(0.01);
  params.improve_budget = 0.0;
  params.max_iterations = 200'000;
  return params;
}

ParkingCase madeCase(const std::string& name) {
  static const std::vector<ParkingCase> cases = benchmark::makeParkingCases(1);
  for (const ParkingCase& task : cases) {
    if (task.name == name) return task;
  }
  throw std::invalid_argument("there is no made case " + name);
}

FreeSpacePlan planned(const ParkingCase& task, const FreeSpaceParams& params = firstPathParams()) {
  return FreeSpacePlanner(task.vehicle, params).plan(task.start, {task.goal}, task.region, {});
}

TEST(LongWays, AreFoundThroughManyGatesAndBetweenManyPosts) {
  for (const char* name : {"slalom_4_7_4", "slalom_8_7_4", "slalom_15_7_4", "lot_200x150_500", "maze_6", "road_3000"}) {
    const ParkingCase task = madeCase(name);
    const FreeSpacePlan result = planned(task);
    EXPECT_TRUE(joins(result.path, task.start, task.goal)) << name;
    EXPECT_TRUE(isDrivable(result.path, task.vehicle)) << name;
    EXPECT_TRUE(staysClear(result.path, task.vehicle, task.region, 0.008)) << name;
  }
}

TEST(TightPlaces, AreShuffledThrough) {
  for (const char* name : {"tee_3.4", "turn_5.3"}) {
    const ParkingCase task = madeCase(name);
    const FreeSpacePlan result = planned(task);
    EXPECT_TRUE(joins(result.path, task.start, task.goal)) << name;
    EXPECT_TRUE(isDrivable(result.path, task.vehicle)) << name;
    EXPECT_TRUE(staysClear(result.path, task.vehicle, task.region, 0.008)) << name;
    EXPECT_GT(result.gear_changes, 8U) << name;
  }
}

TEST(LongWays, GetCheaperWithMoreWork) {
  const ParkingCase task = madeCase("lot_100x60_100");
  FreeSpaceParams params = firstPathParams();
  params.improve_budget = 300.0;
  params.improve_iterations = 5000;
  const FreeSpacePlan result = planned(task, params);
  EXPECT_LT(result.cost, result.first_path_cost);
  EXPECT_TRUE(joins(result.path, task.start, task.goal));
  EXPECT_TRUE(isDrivable(result.path, task.vehicle));
}

/// A budget of work, so that results do not depend on the clock.
FreeSpaceParams improvingParams() {
  FreeSpaceParams params = firstPathParams();
  params.improve_budget = 300.0;
  params.improve_iterations = 60'000;
  return params;
}

TEST(LongWays, LoseGearChangesThatAreDearerThanAnotherWay) {
  for (const auto& [name, most_changes] : {std::pair("slalom_8_7_4", 12U), {"slalom_10_7_4", 14U}}) {
    const ParkingCase task = madeCase(name);
    const FreeSpacePlan result = planned(task, improvingParams());
    EXPECT_LE(result.gear_changes, most_changes) << name;
    EXPECT_LT(result.cost, result.first_path_cost) << name;
    EXPECT_TRUE(joins(result.path, task.start, task.goal)) << name;
    EXPECT_TRUE(isDrivable(result.path, task.vehicle)) << name;
    EXPECT_TRUE(staysClear(result.path, task.vehicle, task.region, 0.008)) << name;
  }
}

TEST(LongWays, KeepGearChangesThatCostNothing) {
  const ParkingCase task = madeCase("slalom_8_7_4");
  FreeSpaceParams params = improvingParams();
  params.gear_change_cost = 0.0;
  const FreeSpacePlan result = planned(task, params);
  EXPECT_GE(result.gear_changes, 13U);
  EXPECT_TRUE(isDrivable(result.path, task.vehicle));
}

TEST(LongWays, AreTheSameForTheSameSeed) {
  const ParkingCase task = madeCase("slalom_8_7_4");
  const FreeSpacePlan first = planned(task, improvingParams()), second = planned(task, improvingParams());
  EXPECT_EQ(first.cost, second.cost);
  EXPECT_EQ(first.path.size(), second.path.size());
}

std::string refusalOf(const ParkingCase& task) {
  try {
    planned(task);
  } catch (const NoPath& error) {
    return error.what();
  }
  return "a path was found";
}

TEST(NarrowPassages, AreNamedWhereTheyCloseTheWay) {
  const std::string refusal = refusalOf(madeCase("gap_-0.02"));
  EXPECT_NE(refusal.find("the widest way is only 1.88 m wide at (0."), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("; the vehicle needs 1.92 m"), std::string::npos) << refusal;
  EXPECT_NE(refusalOf(madeCase("gap_-0.4")).find("only 1.50 m wide"), std::string::npos);
  EXPECT_EQ(refusalOf(madeCase("gap_0.1")), "a path was found");
}

TEST(TightPlaces, AreToldWhereTheVehicleIsTooLongForThem) {
  const std::string refusal = refusalOf(madeCase("tee_2.7"));
  EXPECT_NE(refusal.find("there is too little room to turn to that heading"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace external_command
