// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/pose.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace external_command {
namespace {

TEST(Pose, TakesWhatRelativeToGivesBackToWhereItWas) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1000.0, 1000.0), angle(-10.0, 10.0);
  for (int i = 0; i < 1000; ++i) {
    const Pose2d frame{place(random), place(random), angle(random)}, pose{place(random), place(random), angle(random)};
    const Pose2d back = compose(frame, relativeTo(frame, pose));
    EXPECT_NEAR((back.position() - pose.position()).norm(), 0.0, 1e-9);
    EXPECT_NEAR(angleBetween(back.heading, pose.heading), 0.0, 1e-9);
  }
}

TEST(Pose, ComposesAheadAndToTheLeft) {
  const Pose2d pose = compose({10, 20, M_PI / 2}, {3, 1, 0.5});
  EXPECT_NEAR(pose.x, 9.0, 1e-12);
  EXPECT_NEAR(pose.y, 23.0, 1e-12);
  EXPECT_NEAR(pose.heading, M_PI / 2 + 0.5, 1e-12);
}

TEST(Angles, AreNormalizedAndTurnTheShortWay) {
  EXPECT_NEAR(normalizeAngle(3 * M_PI + 0.1), -M_PI + 0.1, 1e-12);
  EXPECT_NEAR(angleBetween(M_PI - 0.1, -M_PI + 0.1), 0.2, 1e-12);
  EXPECT_NEAR(angleBetween(-M_PI + 0.1, M_PI - 0.1), -0.2, 1e-12);
  EXPECT_NEAR(headingOf(unitVector(2.5)), 2.5, 1e-12);
  EXPECT_GT(cross({1, 0}, {0, 1}), 0.0);
}

TEST(Points, ArePlausibleWithinTheReachOfAnyProjection) {
  EXPECT_TRUE(isPlausible({0, 0}));
  EXPECT_TRUE(isPlausible({500000.0, 9999999.0}));
  for (const double bad : {1e9, -1e9, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_FALSE(isPlausible({bad, 0}));
    EXPECT_FALSE(isPlausible({0, bad}));
  }
}

}  // namespace
}  // namespace external_command
