// SPDX-License-Identifier: Apache-2.0
// Obstacle grids of any shape: an area is planned, or refused with a reason, and in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>

#include "external_command/core/error.h"
#include "external_command/coverage/coverage_planner.h"

namespace external_command {
namespace {

constexpr unsigned kCells = 150;
constexpr double kResolution = 0.2;  // [m]

CoverageArea areaWith(OccupancyGrid grid) {
  const double side = grid.width * grid.resolution;
  CoverageArea area{Polygon({{0, 0}, {side, 0}, {side, side}, {0, side}}, "yard"), {}};
  area.grid = std::move(grid);
  return area;
}

OccupancyGrid emptyGrid(unsigned cells = kCells) {
  OccupancyGrid grid;
  grid.resolution = kResolution;
  grid.width = grid.height = cells;
  grid.cells.assign(std::size_t{cells} * cells, 0);
  return grid;
}

/// Walls one cell wide that turn at random, cross each other and themselves.
OccupancyGrid gridOfWalls(unsigned seed) {
  OccupancyGrid grid = emptyGrid();
  std::mt19937 random(seed);
  const auto below = [&random](int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random); };
  for (int wall = 0; wall < 6; ++wall) {
    int x = below(kCells), y = below(kCells);
    for (int turn = 0; turn < 12; ++turn) {
      const int dx = below(3) - 1, dy = below(3) - 1;
      for (int length = below(30); length > 0; --length) {
        x = std::clamp(x + dx, 0, static_cast<int>(kCells) - 1);
        y = std::clamp(y + dy, 0, static_cast<int>(kCells) - 1);
        grid.cells[static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x)] = 100;
      }
    }
  }
  return grid;
}

OccupancyGrid gridOfNoise(double share, unsigned cells) {
  OccupancyGrid grid = emptyGrid(cells);
  std::mt19937 random(1);
  std::bernoulli_distribution is_filled(share);
  for (auto& cell : grid.cells) cell = is_filled(random) ? 100 : 0;
  return grid;
}

CoverageParams paramsFor(double time_budget) {
  CoverageParams params;
  params.time_budget = time_budget;
  return params;
}

/// How long it took [s]. Anything but an Error ends the test.
double planOrRefuse(const CoverageArea& area, double time_budget, const CancelToken& cancel = {}) {
  const auto begin = std::chrono::steady_clock::now();
  try {
    CoveragePlanner({}, paramsFor(time_budget)).plan(area, std::nullopt, {}, cancel);
  } catch (const Error& error) {
    EXPECT_STRNE(error.what(), "");
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(GridObstacles, OfThinWallsArePlannedRoundOrRefused) {
  for (unsigned seed = 1; seed <= 12; ++seed) planOrRefuse(areaWith(gridOfWalls(seed)), 0.3);
}

TEST(GridObstacles, OfNoiseAreGivenUpInTime) {
  for (const double share : {0.02, 0.2, 0.5}) {
    EXPECT_LT(planOrRefuse(areaWith(gridOfNoise(share, 1000)), 0.5), 5.0) << share << " of the cells";
  }
}

TEST(GridObstacles, OfNoiseEndWhenTheyAreCancelled) {
  const CancelSource cancel;
  std::thread later([&cancel] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cancel.cancel();
  });
  EXPECT_LT(planOrRefuse(areaWith(gridOfNoise(0.2, 1000)), 3600.0, cancel.token()), 5.0);
  later.join();
}

/// Starts to measure anew the most memory that the process has held.
void forgetPeakMemory() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// Of the process [MB].
double memory(const std::string& which) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(which + ":", 0) == 0) return std::stod(line.substr(which.size() + 1)) / 1024.0;
  }
  throw std::runtime_error("/proc/self/status has no " + which);
}

/// Beside that of the area itself [MB].
double memoryToPlan(const CoverageArea& area) {
  const double before = memory("VmRSS");
  forgetPeakMemory();
  planOrRefuse(area, 5.0);
  return memory("VmHWM") - before;
}

TEST(GridObstacles, TakeNoMoreMemoryThanTheirRowsWhetherRefusedOrPlanned) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "what is freed is kept for a while, and memory has a shadow";
#endif
  CoverageArea area = areaWith(emptyGrid(8000));
  auto& cells = area.grid->cells;
  constexpr double kMost = 250.0;  // [MB], of which a copy of the grid has 64
  std::fill(cells.begin(), cells.end(), 100);
  EXPECT_LT(memoryToPlan(area), kMost) << "everything is blocked";
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = (i / 8000 + i) % 2 == 0 ? 100 : 0;
  EXPECT_LT(memoryToPlan(area), kMost) << "a chessboard";
}

TEST(GridObstacles, TooManyAreRefused) {
  CoverageParams params = paramsFor(3600.0);
  for (const std::size_t most : {params.max_grid_rows, std::size_t{10}}) {
    params.max_grid_rows = most;
    try {
      CoveragePlanner({}, params).plan(areaWith(gridOfNoise(0.3, 2000)), std::nullopt, {}, {});
      FAIL() << "it was planned";
    } catch (const InvalidRequest& error) {
      const std::string limit = "more than " + std::to_string(most) + " rows of obstacles";
      EXPECT_NE(std::string(error.what()).find(limit), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("~coverage/max_grid_rows"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace external_command
