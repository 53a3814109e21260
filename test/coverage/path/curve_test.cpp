// SPDX-License-Identifier: Apache-2.0
// Poses along a curve.
#include "coverage/path/curve.h"

#include <gtest/gtest.h>

#include <vector>

namespace external_command {
namespace {

/// Forward to the left, straight back, forward to the right.
Curve toAndFro() { return {{3.0, -2.0, 0.7}, {{4.0, 0.2}, {-3.0, 0.0}, {5.5, -0.1}}}; }

void expectSame(const Pose2d& a, const Pose2d& b) {
  EXPECT_NEAR(a.x, b.x, 1e-9);
  EXPECT_NEAR(a.y, b.y, 1e-9);
  EXPECT_NEAR(a.heading, b.heading, 1e-9);
}

TEST(EvenPoses, AreThoseAtEqualDistances) {
  const Curve curve = toAndFro();
  for (const int n : {1, 2, 5, 25, 1000}) {
    const std::vector<Pose2d> poses = evenPoses(curve, n);
    ASSERT_EQ(poses.size(), static_cast<std::size_t>(n) + 1);
    for (int i = 0; i <= n; ++i) expectSame(poses[static_cast<std::size_t>(i)], poseAt(curve, curve.length() * i / n));
  }
}

TEST(EvenPoses, OfACurveWithoutLengthAreItsStart) {
  for (const Pose2d& pose : evenPoses({{1.0, 2.0, 3.0}, {}}, 3)) expectSame(pose, {1.0, 2.0, 3.0});
}

}  // namespace
}  // namespace external_command
