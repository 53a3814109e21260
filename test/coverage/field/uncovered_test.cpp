// SPDX-License-Identifier: Apache-2.0
// Connected parts of what is left unswept, and which of them one more way would leave.
#include "coverage/field/uncovered.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "coverage/field/tally.h"

namespace external_command {
namespace {

constexpr double kSide = 20.0;  // [m]
constexpr double kWidth = 2.0;  // of the tool [m]

/// A square of cells of 0.5 m, all of them to be swept, among some that are not.
CoverageGrid square() {
  CoverageGrid grid(BoundingBox{{0.0, 0.0}, {kSide, kSide}}, 0.5);
  for (int row = grid.rowOf(0.0); row < grid.rowOf(kSide); ++row) {
    const auto first = grid.data() + (grid.row(row) - grid.row(0));
    for (int column = grid.columnOf(0.0); column < grid.columnOf(kSide); ++column) first[column] |= kGoal;
  }
  return grid;
}

/// The cell that holds a point.
std::pair<int, int> cellAt(double x, double y) { return {square().columnOf(x), square().rowOf(y)}; }

/// From edge to edge along y.
Curve swathAt(double y) { return {Pose2d{0.0, y, 0.0}, {{kSide, 0.0}}}; }

/// One swath is swept, so that two strips are left: 5 m and 13 m wide.
CoverageGrid squareInTwo() {
  CoverageGrid grid = square();
  grid.sweep(swathAt(6.0), kWidth);
  return grid;
}

TEST(UnsweptParts, AreFoundWhereTheyAreLargeEnough) {
  const std::vector<UnsweptPart> parts = unsweptParts(squareInTwo(), 50.0);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].size(), 400U);
  EXPECT_EQ(parts[1].size(), 1040U);
}

TEST(UnsweptParts, AreNotFoundWhereTheyAreSmaller) { EXPECT_EQ(unsweptParts(squareInTwo(), 150.0).size(), 1U); }

TEST(UnsweptPartsAtCells, AreFoundOnceHoweverManyCellsLieInThem) {
  const CoverageGrid grid = squareInTwo();
  const std::vector<UnsweptPart> parts = unsweptParts(grid, 50.0, {cellAt(1.7, 1.7), cellAt(10.2, 2.7)});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].size(), 400U);
}

TEST(UnsweptPartsAtCells, AreNotFoundFromCellsThatAreSwept) {
  EXPECT_TRUE(unsweptParts(squareInTwo(), 50.0, {cellAt(5.2, 6.2), cellAt(15.2, 5.7)}).empty());
}

TEST(TallyCells, AreThoseThatNoOtherWaySweeps) {
  Tally tally(square(), kWidth);
  tally.add(swathAt(6.0));
  tally.add(swathAt(7.0));
  const UnsweptPart cells = tally.cellsOnly(swathAt(7.0));
  ASSERT_EQ(cells.size(), 80U);
  for (const auto& [column, row] : cells) EXPECT_GT(tally.grid().centre(column, row).y(), 7.0);
}

TEST(TallyCells, AreNoneOfAWayThatOthersSweepToo) {
  Tally tally(square(), kWidth);
  for (const double y : {5.0, 6.0, 7.0}) tally.add(swathAt(y));
  EXPECT_TRUE(tally.cellsOnly(swathAt(6.0)).empty());
}

}  // namespace
}  // namespace external_command
