// SPDX-License-Identifier: Apache-2.0
#include "coverage/field/field.h"

#include <gtest/gtest.h>

#include <vector>

#include "../sweeper.h"

namespace external_command {
namespace {

/// A strip of 5 m, and fingers of 3.6 m that reach 18 m up from it, each 2 m from the next:
///   +-+ +-+ +-+
///   | | | | | |
///   | +-+ +-+ |  ...
///   +---------+
Polygon comb(int fingers) {
  std::vector<Point2d> points{{0, 0}, {0, 4.99}};
  for (int i = 0; i < fingers; ++i) {
    const double x = 5.6 * i;
    for (const Point2d& point : std::vector<Point2d>{{x, 5}, {x, 23}, {x + 3.6, 23}, {x + 3.6, 5}}) {
      points.push_back(point);
    }
  }
  points.emplace_back(points.back().x(), 0.0);
  return {points, "comb"};
}

TEST(Field, HasForItsGoalWhatTheToolReachesInFingers) {
  for (int fingers = 2; fingers <= 20; ++fingers) {
    const Polygon area = comb(fingers);
    const Field field(sweeper(), params(), {area, {}}, std::nullopt, {});
    EXPECT_GT(areaOf(field.goal()), 0.98 * area.area()) << fingers << " fingers";
    EXPECT_LT(areaOf(field.goal()), 1.001 * area.area()) << fingers << " fingers";
  }
}

}  // namespace
}  // namespace external_command
