// SPDX-License-Identifier: Apache-2.0
#include "coverage/work/bypass.h"

#include <gtest/gtest.h>

#include "../sweeper.h"

namespace external_command {
namespace {

constexpr double kBin = 0.25;

/// A line along x through a hall, and what BypassSearch says of the first place where it is blocked.
class Line {
 public:
  Line(const std::vector<Polygon>& holes, double y)
      : field_(sweeper(), params(), {box(0, 0, 40, 20), holes}, std::nullopt, {}),
        grid_(field_.makeGrid()),
        profile_(Remains(grid_, kBin), 0.0, kBin),
        across_(y - profile_.point(0.0, 0.0).y()) {}

  int firstBlocked() const {
    int column = columnAt(10.0);
    while (search().isOpen(profile_, across_, column)) ++column;
    return column;
  }

  std::optional<Bypass> bypass() const { return search().find(profile_, across_, firstBlocked()); }

  int columnAt(double x) const { return static_cast<int>((x - profile_.point(0.0, 0.0).x()) / kBin); }

 private:
  BypassSearch search() const { return BypassSearch(field_, grid_); }

  Field field_;
  CoverageGrid grid_;
  Profile profile_;
  double across_;
};

TEST(BypassSearch, PassesAPostOnTheNearerSide) {
  const Line line({post(20.0, 10.2)}, 10.0);
  const std::optional<Bypass> bypass = line.bypass();
  ASSERT_TRUE(bypass);
  EXPECT_NEAR(bypass->shift, -(0.3 + 0.65 + 0.03 - 0.2), 0.2);
  EXPECT_GT(bypass->end, line.columnAt(20.3));
  EXPECT_LT(bypass->end, line.columnAt(22.0));
  EXPECT_GT(bypass->more, 0.0);
  EXPECT_LT(bypass->more, 1.0);
}

TEST(BypassSearch, LeavesTheMoreTheFartherItIs) {
  const std::optional<Bypass> near = Line({post(20.0, 10.7)}, 10.0).bypass();
  const std::optional<Bypass> middle = Line({post(20.0, 10.1)}, 10.0).bypass();
  ASSERT_TRUE(near && middle);
  EXPECT_LT(near->left, 0.6 * middle->left);
  EXPECT_LT(middle->left, 8.0);
}

TEST(BypassSearch, FindsNoWayThroughARowOfPosts) {
  std::vector<Polygon> row;
  for (double y = 0.5; y < 20.0; y += 1.5) row.push_back(post(20.0, y));
  EXPECT_FALSE(Line(row, 10.0).bypass());
}

TEST(BypassSearch, FindsNoWayRoundTheTipOfALargeHole) {
  EXPECT_FALSE(Line({box(16, 9.5, 24, 16)}, 9.5).bypass()) << "that is for laps";
}

}  // namespace
}  // namespace external_command
