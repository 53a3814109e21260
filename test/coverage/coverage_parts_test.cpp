// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sweeper.h"

namespace external_command {
namespace {

/// Length of the swaths, laps not counted, that lie along x and along y.
struct Directions {
  double along_x = 0.0;
  double along_y = 0.0;
};

Directions directionsOf(const CoverageResult& result) {
  Directions sums;
  for (const SwathLine& line : result.lines) {
    if (line.isLap()) continue;
    (std::abs(std::cos(line.start.heading)) > 0.99 ? sums.along_x : sums.along_y) += line.length();
  }
  return sums;
}

/// Two arms, each longer than wide:
///   +--+
///   |  |
///   |  +----+
///   +-------+
const CoverageArea kAngle{Polygon({{0, 0}, {120, 0}, {120, 48}, {54, 48}, {54, 120}, {0, 120}}, "angle"), {}};

TEST(CoverageParts, AreSweptAlongTheirLongerSides) {
  const CoverageResult result = planned(kAngle);
  const Directions sums = directionsOf(result);
  EXPECT_GT(std::min(sums.along_x, sums.along_y), 0.3 * std::max(sums.along_x, sums.along_y));
  EXPECT_GT(result.coverage_ratio, 0.98);
  EXPECT_TRUE(isDrivable(result.path, kAngle));
}

TEST(CoverageParts, TakeFewerTurnsThanOneDirection) {
  CoverageParams straight = params();
  straight.swath_heading = 0.0;
  const CoverageResult one = CoveragePlanner(sweeper(), straight).plan(kAngle, kStart, {}, {});
  const CoverageResult parts = planned(kAngle);
  EXPECT_LT(parts.turns, one.turns);
  EXPECT_LT(parts.length, one.length);
}

TEST(CoverageParts, AreNotMadeOfARectangle) {
  const Directions sums = directionsOf(planned({box(0, 0, 60, 40), {}}));
  EXPECT_LT(std::min(sums.along_x, sums.along_y), 0.1 * std::max(sums.along_x, sums.along_y));
}

TEST(CoverageParts, KeepToTheHeadingThatIsWished) {
  CoverageParams wished = params();
  wished.swath_heading = 0.0;
  EXPECT_EQ(directionsOf(CoveragePlanner(sweeper(), wished).plan(kAngle, kStart, {}, {})).along_y, 0.0);
}

}  // namespace
}  // namespace external_command
