// SPDX-License-Identifier: Apache-2.0
#include "coverage/path/side_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/motion/reeds_shepp.h"

namespace external_command {
namespace {

double lengthTo(const Pose2d& to, double radius) {
  double sum = 0.0;
  for (const ArcSegment& arc : shortestDubins({0.0, 0.0, 0.0}, to, radius)) sum += std::abs(arc.length);
  return sum;
}

TEST(SideStep, TakesAsFarAsTheShortestWayForward) {
  for (const double shift : {-3.0, -0.4, 0.1, 1.0, 4.5}) {
    const SideStep step(shift, 2.5);
    EXPECT_NEAR(lengthTo({step.along, shift, 0.0}, 2.5), step.along + step.more, 2e-3) << shift;
  }
}

TEST(SideStep, IsNotPossibleInLess) {
  const SideStep step(1.0, 2.5);
  EXPECT_GT(lengthTo({0.95 * step.along, 1.0, 0.0}, 2.5), 2.0 * (step.along + step.more)) << "but in a loop";
}

TEST(SideStep, TakesNothingWhereThereIsNoneToMake) {
  EXPECT_EQ(SideStep(0.0, 2.5).along, 0.0);
  EXPECT_EQ(SideStep(0.0, 2.5).more, 0.0);
}

}  // namespace
}  // namespace external_command
