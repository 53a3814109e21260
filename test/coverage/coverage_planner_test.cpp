// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_planner.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "external_command/core/error.h"
#include "sweeper.h"

namespace external_command {
namespace {

TEST(CoveragePlanner, SweepsARectangle) {
  const CoverageArea area{box(0, 0, 40, 30), {}};
  const CoverageResult result = planned(area);
  EXPECT_GT(result.coverage_ratio, 0.95);
  EXPECT_NEAR(result.free_area, 1200.0, 12.0);
  EXPECT_TRUE(isDrivable(result.path, area));
  EXPECT_LT((result.path.front().pose().position() - kStart.position()).norm(), 1e-6);
  EXPECT_EQ(result.swaths.size(), result.lines.size());
}

TEST(CoveragePlanner, KeepsOutOfHoles) {
  const CoverageArea area{box(0, 0, 40, 30), {box(18, 12, 22, 16), box(30, 20, 31, 21)}};
  const CoverageResult result = planned(area);
  EXPECT_GT(result.coverage_ratio, 0.9);
  EXPECT_TRUE(isDrivable(result.path, area));
}

TEST(CoveragePlanner, NamesAnAreaThatIsTooLarge) {
  try {
    planned({Polygon(box(0, 0, 30'000, 30).points(), "the steppe"), {}});
    FAIL() << "it was planned";
  } catch (const InvalidRequest& error) {
    EXPECT_EQ(std::string(error.what()).find("the steppe is 30000.00 m across"), 0u) << error.what();
  }
}

TEST(CoveragePlanner, WorksOnSwathsAndNowhereElse) {
  const CoverageResult result = planned({box(0, 0, 40, 30), {}});
  std::set<std::size_t> working;
  for (const Swath& swath : result.swaths) {
    for (std::size_t i = swath.first + 1; i <= swath.last; ++i) working.insert(i);
  }
  for (std::size_t i = 0; i < result.path.size(); ++i) EXPECT_EQ(result.path[i].tool_on, working.count(i) == 1) << i;
}

/// Whether there is work along the left border, `away` [m] from it.
bool worksAlongTheLeft(const CoverageResult& result, double away) {
  std::size_t points = 0;
  for (const ReferencePoint& point : result.path) {
    points += point.tool_on && std::abs(point.x - away) < 0.15 && std::abs(std::cos(point.heading)) < 0.1;
  }
  return points > 10;
}

CoverageResult plannedWith(const CoverageParams& wished) {
  return CoveragePlanner(sweeper(), wished).plan({box(0, 0, 40, 30), {}}, kStart, {}, {});
}

TEST(CoveragePlanner, DrivesAsManyHeadlandLapsAsAreWished) {
  for (const int laps : {0, 1, 3}) {
    CoverageParams wished = params();
    wished.headland_laps = laps;
    wished.swath_heading = 0.0;
    const CoverageResult result = plannedWith(wished);
    for (int lap = 0; lap < 4; ++lap) EXPECT_EQ(worksAlongTheLeft(result, 0.8 + 1.6 * lap), lap < laps) << laps;
    EXPECT_TRUE(isDrivable(result.path, {box(0, 0, 40, 30), {}}));
  }
}

TEST(CoveragePlanner, DrivesTheHeadlandFirstOrLast) {
  for (const bool first : {true, false}) {
    CoverageParams wished = params();
    wished.headland_laps = 1;
    wished.headland_first = first;
    const CoverageResult result = plannedWith(wished);
    const auto isAtTheBorder = [&](const Swath& swath) {
      return box(0, 0, 40, 30).distanceToBorder(result.path[(swath.first + swath.last) / 2].pose().position()) < 0.9;
    };
    EXPECT_EQ(isAtTheBorder(result.swaths.front()), first);
    EXPECT_EQ(isAtTheBorder(result.swaths.back()), !first);
  }
}

TEST(CoveragePlanner, LaysTheSwathsInTheDirectionThatIsWished) {
  CoverageParams wished = params();
  wished.headland_laps = 0;
  wished.swath_heading = 0.5;
  for (const SwathLine& line : plannedWith(wished).lines) {
    EXPECT_NEAR(std::remainder(line.start.heading - 0.5, M_PI), 0.0, 1e-6);
  }
}

TEST(CoveragePlanner, IsRepeatable) {
  const CoverageResult first = planned({box(0, 0, 30, 20), {}}), second = planned({box(0, 0, 30, 20), {}});
  ASSERT_EQ(first.path.size(), second.path.size());
  for (std::size_t i = 0; i < first.path.size(); ++i) EXPECT_EQ(first.path[i].x, second.path[i].x);
}

/// The plan of `result` of which the first `count` lines are swept.
CoverageProgress progressOf(const CoverageResult& result, std::size_t count) {
  CoverageProgress progress;
  progress.lines = result.lines;
  for (std::size_t i = 0; i < count; ++i) progress.sweep(i, progress.lines[i].length());
  return progress;
}

TEST(CoveragePlanner, GoesOnWhereAnEarlierRunStopped) {
  const CoverageArea area{box(0, 0, 40, 30), {}};
  const CoverageResult whole = planned(area);
  const CoverageProgress progress = progressOf(whole, whole.lines.size() / 2);
  const CoverageResult rest = planned(area, progress);
  EXPECT_EQ(rest.lines.size(), whole.lines.size());
  EXPECT_EQ(rest.swaths.size() + progress.countDone(), whole.lines.size());
  EXPECT_EQ(rest.swaths.front().index, progress.countDone());
  EXPECT_LT(rest.length, whole.length);
  EXPECT_NEAR(rest.coverage_ratio, whole.coverage_ratio, 0.01);
  EXPECT_TRUE(isDrivable(rest.path, area));
}

CoverageResult plannedWithLaps(const CoverageArea& area, const Pose2d& start, const CoverageProgress& progress = {}) {
  CoverageParams wished = params();
  wished.headland_laps = 2;
  return CoveragePlanner(sweeper(), wished).plan(area, start, progress, {});
}

TEST(CoveragePlanner, LeavesAStartNearerToTheBorderThanTheMarginAndSaysSo) {
  const CoverageArea area{box(0, 0, 40, 30), {}};
  CoverageParams wished = params();
  wished.margin = 0.1;
  const Pose2d close{5.0, 0.65 + 0.04, 0.0};  // 4 cm from the border
  const CoverageResult result = CoveragePlanner(sweeper(), wished).plan(area, close, {}, {});
  EXPECT_GT(result.coverage_ratio, 0.95);
  EXPECT_TRUE(isDrivable(result.path, area));
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings.front(),
            "at the start (5.00, 0.69, 0.000) the footprint is nearer to the border of box than the margin of "
            "0.10 m, by 0.06 m; it leaves with a smaller margin");
}

TEST(CoveragePlanner, SaysNothingOfAStartThatKeepsTheMargin) {
  CoverageParams wished = params();
  wished.margin = 0.1;
  const Pose2d away{5.0, 0.65 + 0.12, 0.0};
  EXPECT_TRUE(CoveragePlanner(sweeper(), wished).plan({box(0, 0, 40, 30), {}}, away, {}, {}).warnings.empty());
}

TEST(CoveragePlanner, TellsLapsFromSwaths) {
  const CoverageResult result = plannedWithLaps({box(0, 0, 40, 30), {}}, kStart);
  EXPECT_TRUE(result.lines.front().isLap());
  EXPECT_EQ(result.lines.back().lap, -1);
  std::set<int> laps;
  for (const SwathLine& line : result.lines) laps.insert(line.lap);
  EXPECT_EQ(laps, (std::set<int>{-1, 0, 1}));
}

/// The area that `result` covers up to its point `reached`.
double coveredUpTo(const CoverageResult& result, std::size_t reached) {
  double area = 0.0;
  for (const Swath& swath : result.swaths) {
    EXPECT_EQ(swath.covered.size(), swath.last - swath.first + 1);
    EXPECT_EQ(swath.covered.back(), swath.covered_area);
    if (reached > swath.first) area += swath.covered[std::min(reached, swath.last) - swath.first];
  }
  return area;
}

double todoOf(const CoverageResult& result) { return coveredUpTo(result, result.path.size()); }

TEST(CoveragePlanner, DrivesTheRestOfALapThatWasBegun) {
  const CoverageArea area{box(0, 0, 40, 30), {}};
  const CoverageResult whole = plannedWithLaps(area, kStart);
  const Swath& lap = whole.swaths.front();
  for (const double share : {0.1, 0.5, 0.9}) {
    const std::size_t reached = lap.first + static_cast<std::size_t>(share * (lap.last - lap.first));
    const double swept = whole.path[reached].s - whole.path[lap.first].s;
    CoverageProgress progress = progressOf(whole, 0);
    progress.sweep(lap.index, swept);
    const CoverageResult rest = plannedWithLaps(area, whole.path[reached].pose(), progress);
    EXPECT_EQ(rest.swaths.front().index, lap.index);
    EXPECT_EQ(rest.swaths.front().from, swept) << "the vehicle stands there";
    EXPECT_EQ(rest.swaths.front().first, 0u);
    EXPECT_NEAR(rest.swaths.front().length, lap.length - swept, 1e-6);
    EXPECT_EQ(rest.swaths.size(), whole.swaths.size());
    EXPECT_NEAR(rest.covered_area, whole.covered_area, 0.5);
    EXPECT_NEAR(rest.covered_area - todoOf(rest), coveredUpTo(whole, reached), 0.5) << "what the first run swept";
    EXPECT_TRUE(isDrivable(rest.path, area));
  }
}

TEST(CoveragePlanner, GoesOnWhereTheVehicleIsOnTheLineThoughThatIsNotQuiteWhereItWasLeft) {
  const CoverageArea area{box(0, 0, 40, 30), {}};
  const CoverageResult whole = plannedWithLaps(area, kStart);
  const Swath& lap = whole.swaths.front();
  for (const double share : {0.1, 0.5, 0.9}) {
    const std::size_t reached = lap.first + static_cast<std::size_t>(share * (lap.last - lap.first));
    const double at = whole.path[reached].s - whole.path[lap.first].s;
    for (const double shift : {-0.1, 0.1}) {
      CoverageProgress progress = progressOf(whole, 0);
      progress.sweep(lap.index, at + shift);
      const CoverageResult rest = plannedWithLaps(area, whole.path[reached].pose(), progress);
      EXPECT_EQ(rest.swaths.front().first, 0u) << "there is no way to go there";
      EXPECT_NEAR(rest.swaths.front().from, at, 1e-3);
      EXPECT_LE(rest.gear_changes, whole.gear_changes);
      EXPECT_TRUE(isDrivable(rest.path, area));
    }
  }
}

TEST(CoveragePlanner, BacksUpALittleToARestThatTheVehicleStandsBeside) {
  const CoverageArea area{box(0, 0, 40, 30), {}};
  const CoverageResult whole = plannedWithLaps(area, kStart);
  const Swath& swath = whole.swaths[3];
  const std::size_t reached = (swath.first + swath.last) / 2;
  CoverageProgress progress = progressOf(whole, 3);
  progress.sweep(swath.index, whole.path[reached].s - whole.path[swath.first].s);
  Pose2d beside = whole.path[reached].pose();
  beside.x -= 0.1 * std::sin(beside.heading);
  beside.y += 0.1 * std::cos(beside.heading);
  const CoverageResult rest = plannedWithLaps(area, beside, progress);
  const Swath& first = rest.swaths.front();
  EXPECT_EQ(first.index, swath.index);
  EXPECT_LE(first.from, progress.sweptOf(swath.index));
  EXPECT_GE(first.from, progress.sweptOf(swath.index) - 2.0 * sweeper().min_turning_radius);
  EXPECT_LT(rest.path[first.first].s, 4.0 * sweeper().min_turning_radius);
  EXPECT_TRUE(isDrivable(rest.path, area));
}

TEST(CoveragePlanner, TriesSkippedSwathsAtTheEnd) {
  const CoverageArea area{box(0, 0, 30, 20), {}};
  CoverageProgress progress;
  progress.lines = planned(area).lines;
  progress.skipped = {1};
  const CoverageResult result = planned(area, progress);
  EXPECT_EQ(result.swaths.front().index, 0u);
  EXPECT_EQ(result.swaths.back().index, 1u);
  EXPECT_TRUE(isDrivable(result.path, area));
}

TEST(CoveragePlanner, LeavesOutASwathThatANewObstacleBlocks) {
  CoverageProgress progress;
  progress.lines = planned({box(0, 0, 40, 30), {}}).lines;
  const CoverageArea now{box(0, 0, 40, 30), {box(20, 14, 22, 16)}};
  const CoverageResult result = planned(now, progress);
  EXPECT_LT(result.swaths.size(), progress.lines.size());
  EXPECT_FALSE(result.warnings.empty());
  EXPECT_TRUE(isDrivable(result.path, now));
}

TEST(CoveragePlanner, RefusesProgressOfAnotherPlan) {
  CoverageProgress progress;
  progress.swept = {10.0};
  EXPECT_THROW(planned({box(0, 0, 30, 20), {}}, progress), InvalidRequest);
  progress = progressOf(planned({box(0, 0, 40, 30), {}}), 1);
  EXPECT_THROW(planned({box(0, 0, 30, 20), {}}, progress), InvalidRequest) << "its lines leave this area";
}

/// 40 m x 30 m at 0.25 m with one obstacle, 3 m x 1 m, and a field of unknown cells.
OccupancyGrid gridWithObstacle() {
  OccupancyGrid grid;
  grid.resolution = 0.25;
  grid.width = 160;
  grid.height = 120;
  grid.cells.assign(160 * 120, 0);
  const auto fill = [&](unsigned x0, unsigned y0, unsigned x1, unsigned y1, std::int8_t value) {
    for (unsigned y = y0; y < y1; ++y) {
      for (unsigned x = x0; x < x1; ++x) grid.cells[y * 160 + x] = value;
    }
  };
  fill(80, 60, 92, 64, 100);
  fill(100, 20, 150, 100, -1);
  return grid;
}

TEST(CoveragePlanner, KeepsOutOfOccupiedCells) {
  CoverageArea area{box(0, 0, 40, 30), {}};
  area.grid = gridWithObstacle();
  area.grid->unknown_is_blocked = false;
  const CoverageResult result = planned(area);
  EXPECT_TRUE(isDrivable(result.path, {box(0, 0, 40, 30), {box(20, 15, 23, 16)}}));
  EXPECT_NEAR(result.free_area, 1200.0 - 3.0, 5.0);
  EXPECT_GT(result.coverage_ratio, 0.95) << "cells that are unknown are swept";
}

TEST(CoveragePlanner, KeepsOutOfUnknownCellsUnlessToldOtherwise) {
  CoverageArea area{box(0, 0, 40, 30), {}};
  area.grid = gridWithObstacle();
  const CoverageResult result = planned(area);
  EXPECT_TRUE(isDrivable(result.path, {box(0, 0, 40, 30), {box(20, 15, 23, 16), box(25, 5, 37.5, 25)}}));
  EXPECT_NEAR(result.free_area, 1200.0 - 3.0 - 250.0, 20.0);
}

TEST(CoveragePlanner, SweepsBeyondASmallGridUnlessToldOtherwise) {
  CoverageArea area{box(0, 0, 40, 30), {}};
  area.grid = gridWithObstacle();
  area.grid->origin = {1.0, 1.0, 0.1};
  area.grid->width = area.grid->height = 60;  // 15 m to either side
  area.grid->cells.assign(60 * 60, 0);
  EXPECT_GT(planned(area).covered_area, 1100.0);
  area.grid->outside_is_blocked = true;
  EXPECT_NEAR(planned(area).free_area, 15.0 * 15.0, 3.0);
}

TEST(CoveragePlanner, SweepsInsideAFenceOfTheGrid) {
  CoverageArea area{box(0, 0, 40, 30), {}};
  area.grid = gridWithObstacle();
  area.grid->cells.assign(160 * 120, 0);
  for (unsigned x = 0; x < 160; ++x) area.grid->cells[x] = area.grid->cells[119 * 160 + x] = 100;
  for (unsigned y = 0; y < 120; ++y) area.grid->cells[160 * y] = area.grid->cells[160 * y + 159] = -1;
  const CoverageResult result = planned(area);
  EXPECT_NEAR(result.free_area, 39.5 * 29.5, 30.0);
  EXPECT_TRUE(isDrivable(result.path, {box(0.25, 0.25, 39.75, 29.75), {}}));
}

TEST(CoveragePlanner, RefusesAGridThatHoldsFewerCellsThanItSays) {
  CoverageArea area{box(0, 0, 40, 30), {}};
  area.grid = gridWithObstacle();
  area.grid->cells.pop_back();
  EXPECT_THROW(planned(area), InvalidRequest);
}

TEST(CoveragePlanner, RefusesAStartOutsideTheArea) {
  EXPECT_THROW(planned({box(10, 10, 40, 30), {}}), StartBlocked);
  EXPECT_THROW(planned({box(0, 0, 40, 30), {box(4, 4, 8, 8)}}), StartBlocked);
}

TEST(CoveragePlanner, SaysWhatTheStartOverlaps) {
  const auto refusal = [](const CoverageArea& area) -> std::string {
    try {
      planned(area);
      return "";
    } catch (const StartBlocked& error) {
      return error.what();
    }
  };
  const auto gridOf = [](std::int8_t value) {
    OccupancyGrid grid;
    grid.resolution = 1.0;
    grid.width = grid.height = 4;
    grid.origin = {3.0, 3.0, 0.0};
    grid.cells.assign(16, value);
    return grid;
  };
  const Polygon hole = box(30, 20, 31, 21), outer = box(0, 0, 40, 30);
  EXPECT_NE(refusal({box(10, 10, 40, 30), {}}).find("sticks out of box by"), std::string::npos);
  EXPECT_NE(refusal({outer, {hole, Polygon(box(4, 4, 8, 8).points(), "the pond")}}).find("overlaps the pond by"),
            std::string::npos);
  const std::string occupied = refusal({outer, {hole}, gridOf(100)}), unknown = refusal({outer, {hole}, gridOf(-1)});
  EXPECT_NE(occupied.find("overlaps an obstacle of the grid"), std::string::npos) << occupied;
  EXPECT_EQ(occupied.find("unknown"), std::string::npos) << occupied;
  EXPECT_NE(unknown.find("are unknown, which counts as blocked (~grid_unknown_is_blocked)"), std::string::npos)
      << unknown;
}

TEST(CoveragePlanner, RefusesAnAreaTheVehicleDoesNotFitInto) {
  try {
    planned({box(0, 0, 1, 1), {}});
    FAIL() << "accepted";
  } catch (const InvalidRequest& error) {
    EXPECT_NE(std::string(error.what()).find("smaller than the vehicle"), std::string::npos) << error.what();
  }
}

TEST(CoveragePlanner, RefusesHolesThatLeaveNothing) {
  try {
    planned({box(0, 0, 40, 30), {box(1, 1, 2, 2), Polygon(box(-5, -5, 50, 50).points(), "the lake")}});
    FAIL() << "accepted";
  } catch (const InvalidRequest& error) {
    EXPECT_NE(std::string(error.what()).find("the lake leaves nothing"), std::string::npos) << error.what();
  }
}

TEST(CoveragePlanner, StopsWhenItIsCancelled) {
  CancelSource source;
  source.cancel();
  EXPECT_THROW(CoveragePlanner(sweeper(), params()).plan({box(0, 0, 200, 200), {}}, kStart, {}, source.token()),
               Cancelled);
}

TEST(CoverageParams, NameTheKeyThatIsOutOfRange) {
  CoverageParams wrong;
  wrong.swath_width = -1.0;
  try {
    wrong.validate();
    FAIL() << "accepted";
  } catch (const InvalidParameter& error) {
    EXPECT_NE(std::string(error.what()).find("swath_width"), std::string::npos);
  }
}

}  // namespace
}  // namespace external_command
