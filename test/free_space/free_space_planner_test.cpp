// SPDX-License-Identifier: Apache-2.0
#include "external_command/free_space/free_space_planner.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "external_command/core/error.h"
#include "external_command/free_space/planner_log.h"
#include "quick_plans.h"
#include "support/parking_worlds.h"
#include "support/path_matchers.h"

namespace external_command {
namespace {

testing::AssertionResult isValid(const FreeSpacePlan& result, const ParkingWorld& world,
                                 const FreeSpaceParams& params) {
  if (const auto ends = joins(result.path, world.start, world.goal); !ends) return ends;
  if (const auto drivable = isDrivable(result.path, world.vehicle, {params.spacing}); !drivable) return drivable;
  if (std::abs(result.length - result.path.back().s) > 1e-3) return testing::AssertionFailure() << "wrong length";
  if (result.gear_changes != gearChanges(result.path)) return testing::AssertionFailure() << "wrong gear changes";
  return staysClear(result.path, world.vehicle, world.region, params.margin - kMarginSlack);
}

template <class Exception>
std::string messageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

/// A square grid of cells of 10 cm, each `every`-th of which is an obstacle, but for a free street along y = 0.
Region dottedGrid(std::uint32_t side, std::size_t every) {
  Region::Parts parts;
  parts.grid.emplace();
  OccupancyGrid& grid = *parts.grid;
  grid.resolution = 0.1;
  grid.width = side + 1;  // so that the dots of two rows do not line up
  grid.height = side;
  grid.origin = {-0.05 * side, -0.05 * side, 0.0};
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, 0);
  for (std::size_t i = 0; i < grid.cells.size(); i += every) {
    const double row = static_cast<double>(i / grid.width);
    if (std::abs(row - 0.5 * side) > 40.0) grid.cells[i] = 100;
  }
  return Region(std::move(parts));
}

TEST(FreeSpacePlanner, ParksBetweenCarsAtTheKerb) {
  for (const double slack : {2.5, 1.0, 0.6}) {
    const ParkingWorld world = parallelSlot(slack);
    EXPECT_TRUE(isValid(planned(world, quickParams()), world, quickParams())) << slack;
  }
}

TEST(FreeSpacePlanner, LeavesTheSlotAgain) {
  ParkingWorld world = parallelSlot(0.8);
  std::swap(world.start, world.goal);
  EXPECT_TRUE(isValid(planned(world, quickParams()), world, quickParams()));
}

TEST(FreeSpacePlanner, BacksIntoABay) {
  for (const double gap : {1.0, 0.4, 0.25}) {
    const ParkingWorld world = bay(gap);
    EXPECT_TRUE(isValid(planned(world, quickParams()), world, quickParams())) << gap;
  }
}

TEST(FreeSpacePlanner, PassesAGateInsideABorder) {
  for (const double gap : {1.5, 0.6}) {
    const ParkingWorld world = twoYards(gap);
    EXPECT_TRUE(isValid(planned(world, quickParams()), world, quickParams())) << gap;
  }
}

TEST(FreeSpacePlanner, ParksALorry) {
  const ParkingWorld world = bay(0.8, lorry());
  EXPECT_TRUE(isValid(planned(world, quickParams()), world, quickParams()));
}

TEST(FreeSpacePlanner, ManagesRandomPlaces) {
  int solved = 0;
  for (const ParkingWorld& world : randomWorlds(1, 40)) {
    try {
      EXPECT_TRUE(isValid(planned(world, quickParams(0.02)), world, quickParams(0.02)));
      ++solved;
    } catch (const NoPath&) {
    } catch (const PlanningTimeout&) {
    }
  }
  EXPECT_GE(solved, 36);
}

TEST(FreeSpacePlanner, PlansTheSameFarFromTheOrigin) {
  const ParkingWorld world = parallelSlot(0.8);
  const Pose2d frame{4.5e7, -5.5e7, 0.0};
  const ParkingWorld far = moved(world, frame);
  const FreeSpacePlan result = planned(far, quickParams());
  EXPECT_TRUE(joins(result.path, far.start, far.goal));
  EXPECT_NEAR(result.cost, planned(world, quickParams()).cost, 0.5);
  Path back = result.path;
  for (ReferencePoint& point : back) point.x -= frame.x, point.y -= frame.y;
  EXPECT_TRUE(isDrivable(back, world.vehicle));
  EXPECT_TRUE(staysClear(back, world.vehicle, world.region, 0.05 - kMarginSlack));
}

TEST(FreeSpacePlanner, ImprovesThePathWithMoreWork) {
  const ParkingWorld world = twoYards(1.0);
  FreeSpaceParams params = quickParams();
  params.improve_iterations = 20'000;
  const FreeSpacePlan result = planned(world, params);
  EXPECT_LE(result.cost, result.first_path_cost);
  params.planner = "hybrid_astar";
  EXPECT_LT(result.cost, planned(world, params).cost);
}

TEST(FreeSpacePlanner, GivesTheSamePathForTheSameSeed) {
  const ParkingWorld world = parallelSlot(0.7);
  for (const unsigned threads : {1U, 2U}) {
    FreeSpaceParams params = quickParams();
    params.threads = threads;
    const FreeSpacePlan one = planned(world, params), other = planned(world, params);
    ASSERT_EQ(one.path.size(), other.path.size());
    for (std::size_t i = 0; i < one.path.size(); ++i) {
      ASSERT_EQ(one.path[i].x, other.path[i].x);
      ASSERT_EQ(one.path[i].heading, other.path[i].heading);
    }
  }
}

TEST(FreeSpacePlanner, TakesTheCheaperGoal) {
  // Coming along the aisle, nose in is cheaper than backing in.
  ParkingWorld world = bay(1.0);
  const double ahead = world.vehicle.length() - 2.0 * world.vehicle.rear_overhang;
  const Pose2d nose_in{world.goal.x, world.goal.y + ahead, -M_PI / 2.0};
  const FreeSpacePlanner planner(world.vehicle, quickParams());
  const double back_in_cost = planner.plan(world.start, {world.goal}, world.region, {}).cost;
  const double nose_in_cost = planner.plan(world.start, {nose_in}, world.region, {}).cost;
  const FreeSpacePlan either = planner.plan(world.start, {world.goal, nose_in}, world.region, {});
  EXPECT_EQ(either.goal_index, nose_in_cost < back_in_cost ? 1U : 0U);
  EXPECT_NEAR(either.cost, std::min(nose_in_cost, back_in_cost), 1.0);
}

TEST(FreeSpacePlanner, IgnoresABlockedGoalIfThereIsAnother) {
  const ParkingWorld world = bay(1.0);
  Pose2d blocked = world.goal;
  blocked.x += 1.0;
  const FreeSpacePlanner planner(world.vehicle, quickParams());
  EXPECT_EQ(planner.plan(world.start, {blocked, world.goal}, world.region, {}).goal_index, 1U);
}

TEST(FreeSpacePlanner, StaysWhereItIsIfThatIsTheGoal) {
  const FreeSpacePlan result = FreeSpacePlanner(smallCar(), quickParams()).plan({1, 2, 3}, {{1, 2, 3}}, Region(), {});
  EXPECT_EQ(result.length, 0.0);
  EXPECT_EQ(result.path.size(), 1U);
}

TEST(FreeSpacePlanner, SaysWhatTheStartOverlapsAndByHowMuch) {
  ParkingWorld world = parallelSlot(1.0);
  world.start = world.goal;
  world.start.y -= 0.3;  // the kerb is 0.2 m away, the margin 0.05 m
  const std::string message = messageOf<StartBlocked>([&] { planned(world, quickParams()); });
  EXPECT_NE(message.find("start"), std::string::npos) << message;
  EXPECT_NE(message.find("overlaps box by 0.15 m"), std::string::npos) << message;
}

TEST(FreeSpacePlanner, SaysWhatTheGoalSticksOutOf) {
  ParkingWorld world = twoYards(1.0);
  world.goal = world.start;
  world.goal.x = -1.0;
  const std::string message = messageOf<GoalBlocked>([&] { planned(world, quickParams()); });
  EXPECT_NE(message.find("sticks out of box by"), std::string::npos) << message;
}

TEST(FreeSpacePlanner, FindsNoPathThroughAGateThatIsTooNarrow) {
  const ParkingWorld world = twoYards(-0.2);
  FreeSpaceParams params = quickParams();
  params.time_budget = 60.0;
  EXPECT_THROW(planned(world, params), NoPath);
  EXPECT_NO_THROW(planned(twoYards(0.6), params));
}

TEST(FreeSpacePlanner, SaysThatThereIsNoRoomToTurn) {
  const auto turnedIn = [](double width) {
    Region::Parts parts;
    parts.drivable = box({0.0, 0.0}, 60.0, width);
    return planned({smallCar(), {-10, 0, 0}, {10, 0, M_PI}, Region(parts)}, quickParams());
  };
  const std::string message = messageOf<NoPath>([&] { turnedIn(3.8); });
  EXPECT_NE(message.find("too little room to turn to that heading"), std::string::npos) << message;
  EXPECT_NE(message.find("off by at least"), std::string::npos) << message;
  EXPECT_NO_THROW(turnedIn(6.0));
}

TEST(FreeSpacePlanner, FindsNoPathOutOfASlotThatIsTooTight) {
  ParkingWorld world = parallelSlot(0.05);
  const std::string message = messageOf<NoPath>([&] { planned(world, quickParams(0.02)); });
  EXPECT_NE(message.find("no path from"), std::string::npos) << message;
}

TEST(FreeSpacePlanner, AnswersWithinItsTimeBudget) {
  // the gate is wide enough to look into, but not to drive through
  const ParkingWorld world = twoYards(0.101);
  FreeSpaceParams params = quickParams();
  params.time_budget = 0.2;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_ANY_THROW(planned(world, params));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(400));
}

TEST(FreeSpacePlanner, StopsSoonAfterACancel) {
  const ParkingWorld world = twoYards(1.0);
  FreeSpaceParams params = quickParams();
  params.time_budget = 60.0;
  params.improve_budget = 60.0;
  params.improve_iterations = 0;
  const CancelSource source;
  std::chrono::steady_clock::time_point cancelled;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cancelled = std::chrono::steady_clock::now();
    source.cancel();
  });
  EXPECT_THROW(FreeSpacePlanner(world.vehicle, params).plan(world.start, {world.goal}, world.region, source.token()),
               Cancelled);
  other.join();
  EXPECT_LT(std::chrono::steady_clock::now() - cancelled, std::chrono::milliseconds(50));
}

TEST(FreeSpacePlanner, StopsSoonAfterACancelWhileItTakesInAHugeGrid) {
  const ParkingWorld world{smallCar(), {0, 0, 0}, {20, 0, 0}, dottedGrid(4000, 37)};
  const CancelSource source;
  std::chrono::steady_clock::time_point cancelled;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    cancelled = std::chrono::steady_clock::now();
    source.cancel();
  });
  EXPECT_THROW(
      FreeSpacePlanner(world.vehicle, quickParams()).plan(world.start, {world.goal}, world.region, source.token()),
      Cancelled);
  const auto end = std::chrono::steady_clock::now();
  other.join();
  EXPECT_LT(end - cancelled, std::chrono::milliseconds(50));
}

TEST(FreeSpacePlanner, KeepsItsTimeBudgetWhileItTakesInAHugeGrid) {
  const ParkingWorld world{smallCar(), {0, 0, 0}, {20, 0, 0}, dottedGrid(4000, 37)};
  FreeSpaceParams params = quickParams();
  params.time_budget = 0.02;
  const std::string message = messageOf<PlanningTimeout>([&] { planned(world, params); });
  EXPECT_NE(message.find("not all obstacles were taken in within 20 ms (time_budget)"), std::string::npos) << message;
}

TEST(FreeSpacePlanner, RefusesAGridWithMoreEdgesThanItKeepsInMemory) {
  const ParkingWorld world{smallCar(), {0, 0, 0}, {20, 0, 0}, dottedGrid(2700, 2)};
  const std::string message = messageOf<InvalidRequest>([&] { planned(world, quickParams()); });
  EXPECT_NE(message.find("a coarser grid"), std::string::npos) << message;
}

TEST(FreeSpacePlanner, NumbersTheGoalsOnlyWhereThereAreSeveral) {
  const ParkingWorld world = bay(1.0);
  const FreeSpacePlanner planner(world.vehicle, quickParams());
  Pose2d blocked = world.goal, other = world.goal;
  blocked.x += 1.0, other.x -= 1.0;
  const auto ask = [&](const std::vector<Pose2d>& goals) { planner.plan(world.start, goals, world.region, {}); };
  EXPECT_EQ(messageOf<GoalBlocked>([&] { ask({blocked}); }).find("the goal ("), 0U);
  const std::string several = messageOf<GoalBlocked>([&] { ask({blocked, other}); });
  EXPECT_EQ(several.find("goal 0 ("), 0U) << several;
  EXPECT_NE(several.find("; goal 1 ("), std::string::npos) << several;
  EXPECT_EQ(messageOf<InvalidRequest>([&] { ask({{1e6, 0, 0}}); }).find("the goal (1000000.00, 0.00, 0.000) is"), 0U);
}

TEST(FreeSpacePlanner, SaysSoonThatNothingLeadsOutOfARoom) {
  Region::Parts parts;
  for (const double x : {14.0, 38.0}) parts.non_drivable.push_back(box({x, 0.0}, 0.5, 20.0));
  for (const double y : {-10.0, 10.0}) parts.non_drivable.push_back(box({26.0, y}, 24.5, 0.5));
  const ParkingWorld world{smallCar(), {0, 0, 0}, {25, 0, 0}, Region(parts)};
  const std::string message = messageOf<NoPath>([&] { planned(world, quickParams()); });
  EXPECT_NE(message.find("to the goal (25.00, 0.00, 0.000)"), std::string::npos) << message;
}

TEST(FreeSpacePlanner, RefusesARequestWithoutGoalOrWithNumbersThatAreNone) {
  const FreeSpacePlanner planner(smallCar(), quickParams());
  EXPECT_THROW(planner.plan({0, 0, 0}, {}, Region(), {}), InvalidRequest);
  EXPECT_THROW(planner.plan({0, 0, 0}, {{1, 1, 1}}, Region(), {}, {EndState{Direction::kForward, NAN, {}, 0.0}, {}}),
               InvalidRequest);
  EXPECT_THROW(planner.plan({0, 0, 0}, {{1, 1, 1}, {2, 2, 2}}, Region(), {}, {std::nullopt, {EndState{}}}),
               InvalidRequest);
  EXPECT_THROW(planner.plan({0, std::nan(""), 0}, {{1, 1, 1}}, Region(), {}), InvalidRequest);
  EXPECT_THROW(planner.plan({0, 0, 0}, {{1, 1, INFINITY}}, Region(), {}), InvalidRequest);
  EXPECT_THROW(planner.plan({0, 0, 0}, {{1e6, 0, 0}}, Region(), {}), InvalidRequest);
  EXPECT_NO_THROW(planner.plan({0, 0, 0}, {{10, 1, 1}}, Region(), {}));
}

TEST(FreeSpacePlanner, SeesObstaclesOfATurnedGrid) {
  // A wall of cells with a gap, in a grid that stands askew.
  ParkingWorld world{smallCar(), {5, 4, 0.3}, {16, 12, 0.3}, Region()};
  Region::Parts parts;
  parts.grid.emplace();
  parts.grid->resolution = 0.25;
  parts.grid->width = parts.grid->height = 120;
  parts.grid->origin = {-3.0, -8.0, 0.35};
  parts.grid->outside_is_blocked = true;  // else the way leads around the grid
  parts.grid->cells.assign(120 * 120, 0);
  for (std::size_t row = 0; row < 120; ++row) {
    if (row < 50 || row > 64) parts.grid->cells[row * 120 + 62] = 100;
  }
  world.region = Region(parts);
  EXPECT_TRUE(isValid(planned(world, quickParams()), world, quickParams()));
  for (std::size_t row = 0; row < 120; ++row) parts.grid->cells[row * 120 + 62] = -1;
  world.region = Region(parts);
  EXPECT_THROW(planned(world, quickParams()), NoPath);
  parts.grid->unknown_is_blocked = false;
  world.region = Region(parts);
  EXPECT_TRUE(isValid(planned(world, quickParams()), world, quickParams()));
}

TEST(FreeSpacePlanner, RunsThePlannersOfOmplInTheSameFrame) {
  std::string messages;
  const auto log = PlannerLog::acquire([&](PlannerLogLevel, const std::string& message) { messages += message; });
  const ParkingWorld world = bay(4.0);
  ParkingWorld open = world;  // where any sampling planner finds a path soon
  open.region = Region();
  open.goal = compose(open.start, {9.0, 2.0, 0.3});
  for (const std::string& name : freeSpacePlanners()) {
    const bool finds_narrow_places = name != "rrtstar" && name != "kpiece";
    const ParkingWorld& task = finds_narrow_places ? world : open;
    FreeSpaceParams params = quickParams();
    params.planner = name;
    const FreeSpacePlan result = planned(task, params);
    EXPECT_TRUE(isValid(result, task, params)) << name;
    EXPECT_EQ(result.planner, name);
  }
  EXPECT_FALSE(messages.empty());
}

TEST(PlannerLog, IsOneForTheProcessWhileItLives) {
  std::string first, second;
  auto log = PlannerLog::acquire([&](PlannerLogLevel, const std::string& message) { first += message; });
  EXPECT_EQ(PlannerLog::acquire([&](PlannerLogLevel, const std::string& message) { second += message; }), log);
  const ParkingWorld world = bay(4.0);
  FreeSpaceParams params = quickParams();
  params.planner = "rrtconnect";
  planned(world, params);
  EXPECT_FALSE(first.empty());
  log = nullptr;
  log = PlannerLog::acquire([&](PlannerLogLevel, const std::string& message) { second += message; });
  planned(world, params);
  EXPECT_FALSE(second.empty());
}

TEST(FreeSpaceParams, NameTheKeyThatIsOutOfRange) {
  EXPECT_NO_THROW(FreeSpaceParams().validate());
  FreeSpaceParams params;
  params.margin = -0.1;
  EXPECT_NE(messageOf<InvalidParameter>([&] { params.validate(); }).find("margin is -0.1"), std::string::npos);
  params = {};
  params.planner = "teleport";
  EXPECT_NE(messageOf<InvalidParameter>([&] { params.validate(); }).find("one of portfolio, "), std::string::npos);
  params = {};
  params.spacing = std::nan("");
  EXPECT_THROW(params.validate(), InvalidParameter);
  params = {};
  params.threads = 0;
  EXPECT_THROW(FreeSpacePlanner(smallCar(), params), InvalidParameter);
}

TEST(FreeSpacePlanner, PaysForTheGearChangesAtItsEndsWhereItDoesNotStandThere) {
  const FreeSpaceParams params = quickParams();
  const FreeSpacePlanner planner(smallCar(), params);
  const Pose2d behind{-3.0, 0.0, 0.0};
  const auto costWith = [&](const EndStates& ends) { return planner.plan({}, {behind}, Region(), {}, ends).cost; };
  const double standing = costWith({});
  EXPECT_NEAR(standing, 3.0 * params.reverse_factor, 1e-3);
  EXPECT_NEAR(costWith({EndState{}, {}}), standing + params.gear_change_cost, 1e-3);
  EXPECT_NEAR(costWith({EndState{}, {EndState{}}}), standing + 2.0 * params.gear_change_cost, 1e-3);
  EXPECT_NEAR(costWith({EndState{Direction::kReverse, 0.0, {}, 0.0}, {EndState{Direction::kReverse, 0.0, {}, 0.0}}}),
              standing, 1e-3);
}

TEST(FreeSpacePlanner, BeginsInTheGearInWhichTheVehicleArrives) {
  const FreeSpacePlanner planner(smallCar(), quickParams());
  const Pose2d turned{0.0, 0.0, 0.8};
  for (const Direction direction : {Direction::kForward, Direction::kReverse}) {
    const Path path = planner.plan({}, {turned}, Region(), {}, {EndState{direction, 0.0, {}, 0.0}, {}}).path;
    EXPECT_EQ(path[1].direction, direction);
  }
}

}  // namespace
}  // namespace external_command
