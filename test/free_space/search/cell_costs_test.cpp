// SPDX-License-Identifier: Apache-2.0
#include "free_space/search/cell_costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace external_command {
namespace {

std::size_t indexOf(long cell) { return static_cast<std::size_t>(cell); }

/// By relaxing all steps until nothing changes.
std::vector<CellCost> slowCostsTo(const CellGrid& grid, const std::vector<std::uint16_t>& prices, long target) {
  std::vector<CellCost> costs(prices.size(), kUnreachedCell);
  costs[indexOf(target)] = 0;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (long cell = 0; cell < grid.count(); ++cell) {
      if (prices[indexOf(cell)] == 0) continue;
      grid.forEachAround(cell, [&](long next, bool is_across) {
        if (costs[indexOf(next)] == kUnreachedCell) return;
        const CellCost through =
            costs[indexOf(next)] + (is_across ? kAcrossStep : kStraightStep) * prices[indexOf(cell)];
        if (through >= costs[indexOf(cell)]) return;
        costs[indexOf(cell)] = through;
        has_changed = true;
      });
    }
  }
  return costs;
}

TEST(CellCosts, AreThoseOfTheCheapestWays) {
  std::mt19937 random(1);
  const std::vector<std::uint16_t> choices{0, 1, 1, 4, 6, 10, 40, 30'000, 60'000};
  for (int round = 0; round < 20; ++round) {
    const CellGrid grid({-3.0, 2.0}, {3.0, 6.5}, 0.5, 1e6);
    std::vector<std::uint16_t> prices;
    for (long cell = 0; cell < grid.count(); ++cell) prices.push_back(choices[random() % choices.size()]);
    const long target = static_cast<long>(random() % static_cast<unsigned long>(grid.count()));
    EXPECT_EQ(costsTo(grid, prices, target, [](long) { return false; }), slowCostsTo(grid, prices, target));
  }
}

TEST(CellCosts, ComeCheapestFirstUntilStopped) {
  const CellGrid grid({0.0, 0.0}, {10.0, 10.0}, 1.0, 1e6);
  const std::vector<std::uint16_t> prices(static_cast<std::size_t>(grid.count()), 1);
  const long target = grid.at({5.5, 5.5});
  int seen = 0;
  const std::vector<CellCost> costs = costsTo(grid, prices, target, [&seen](long) { return ++seen > 5; });
  EXPECT_EQ(seen, 6);
  EXPECT_EQ(costs[indexOf(target)], 0u);
  EXPECT_EQ(std::count(costs.begin(), costs.end(), kStraightStep), 4);
}

TEST(CellGrid, KnowsWhichCellAPointIsIn) {
  const CellGrid grid({-1.0, -1.0}, {1.0, 1.0}, 0.5, 1e6);
  for (long cell = 0; cell < grid.count(); ++cell) EXPECT_EQ(grid.at(grid.centreOf(cell)), cell);
  EXPECT_EQ(grid.at({-1.01, 0.0}), -1);
  EXPECT_EQ(grid.at({0.0, 5.0}), -1);
}

TEST(CellGrid, HasLargerCellsForAHugeBox) {
  const CellGrid grid({0.0, 0.0}, {10'000.0, 10'000.0}, 0.5, 10'000.0);
  EXPECT_NEAR(grid.cellSize(), 100.0, 1e-9);
  EXPECT_LT(grid.count(), 10'400);
}

}  // namespace
}  // namespace external_command
