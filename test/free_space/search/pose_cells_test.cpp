// SPDX-License-Identifier: Apache-2.0
#include "free_space/search/pose_cells.h"

#include <gtest/gtest.h>

#include <set>

namespace external_command {
namespace {

constexpr double kCell = 0.1, kHeadingCell = 2.0 * M_PI / 64;

TEST(CellOf, TellsApartWhatIsACellApart) {
  std::set<std::uint64_t> cells;
  for (int x = -5; x < 5; ++x) {
    for (int y = -5; y < 5; ++y) {
      for (int i = 0; i < 64; ++i) {
        const Pose2d pose{(x + 0.5) * kCell, (y + 0.5) * kCell, normalizeAngle(i * kHeadingCell)};
        const std::uint64_t cell = cellOf(pose, kCell, kHeadingCell);
        EXPECT_EQ(cell & 1U, 0U);
        cells.insert(cell);
      }
    }
  }
  EXPECT_EQ(cells.size(), 10U * 10U * 64U);
}

TEST(CellOf, IsTheSameForTheSameHeadingOnBothSidesOfATurn) {
  const auto cell = [](double heading) { return cellOf({0.05, 0.05, heading}, kCell, kHeadingCell); };
  EXPECT_EQ(cell(M_PI - 1e-9), cell(-M_PI + 1e-9));
  EXPECT_EQ(cell(0.3), cell(0.3 + 2.0 * M_PI));
  EXPECT_NE(cell(0.3), cell(0.3 + 1.1 * kHeadingCell));
}

TEST(CellNodes, KeepTheNodeOfEachCellHoweverManyThereAre) {
  CellNodes nodes;
  EXPECT_EQ(nodes.at(7), CellNodes::kNone);
  for (int i = 0; i < 50'000; ++i) nodes.set(static_cast<std::uint64_t>(i) << 19, i);
  nodes.set(std::uint64_t{42} << 19, 1);
  for (int i = 0; i < 50'000; ++i) ASSERT_EQ(nodes.at(static_cast<std::uint64_t>(i) << 19), i == 42 ? 1 : i);
  EXPECT_EQ(nodes.at(3), CellNodes::kNone);
  nodes.clear();
  EXPECT_EQ(nodes.at(std::uint64_t{42} << 19), CellNodes::kNone);
}

}  // namespace
}  // namespace external_command
