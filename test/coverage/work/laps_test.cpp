// SPDX-License-Identifier: Apache-2.0
#include "coverage/work/laps.h"

#include <gtest/gtest.h>

#include <vector>

#include "../sweeper.h"

namespace external_command {
namespace {

/// Rooms at both sides of a corridor, with doors that the vehicle just fits through:
///   +----+ +----+ +-- ...
///   |    | |    | |
///   +-  -+ +-  -+ +-
///   +-  -+-+-  -+-+- ...
///   |
///   +-  -+-+-  -+-+- ...
///   +-  -+ +-  -+ +-
///   |    | |    | |
///   +----+ +----+ +-- ...
Polygon rooms() {
  constexpr int kRooms = 5;
  constexpr double kPitch = 10.0, kLength = kRooms * kPitch - 1.0;
  std::vector<Point2d> points;
  for (int i = 0; i < kRooms; ++i) {
    const double x = i * kPitch;
    for (const Point2d& point :
         std::vector<Point2d>{{3.2, 0}, {3.2, -1}, {0, -1}, {0, -9}, {9, -9}, {9, -1}, {5.8, -1}, {5.8, 0}}) {
      points.emplace_back(x + point.x(), point.y());
    }
  }
  points.emplace_back(kLength, 0.0);
  const std::vector<Point2d> half = points;
  for (auto point = half.rbegin(); point != half.rend(); ++point) points.emplace_back(point->x(), 4.0 - point->y());
  points.emplace_back(0.0, 4.0);
  points.emplace_back(0.0, 0.0);
  return {points, "rooms"};
}

TEST(Laps, LeadSomewhereHoweverSmallTheRingsAreThatTheyAreMadeOf) {
  const Field field(sweeper(), params(), {rooms(), {}}, std::nullopt, {});
  for (const double price : {3.0, 4.0, 6.0, 8.0, 12.0, 20.0}) {
    CoverageGrid grid = field.makeGrid();
    std::vector<Work> laps;
    for (int number = 0; number == 0 || !laps.empty(); ++number) {
      laps = planLap(field, number, {1, 0.0, true}, price / field.width(), &grid);
      for (const Work& lap : laps) {
        ASSERT_GT(lap.ways(), 0U) << "lap " << number << " at a price of " << price;
        EXPECT_GT(lap.length(), 0.0) << "lap " << number << " at a price of " << price;
      }
    }
  }
}

}  // namespace
}  // namespace external_command
