// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/arrival.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(VehicleMotion, TellsSpeedAndRestFromPoses) {
  VehicleMotion motion;
  double now = 100.0;
  for (int i = 0; i < 20; ++i, now += 0.1) motion.update({0.5 * i, 0.0, 0.0}, now);
  EXPECT_NEAR(motion.speed(), 5.0, 0.01);
  EXPECT_LT(motion.rest(now), 0.2);
  for (int i = 0; i < 20; ++i, now += 0.1) motion.update({9.5 + 0.01 * (i % 2), 0.0, 0.0}, now);
  EXPECT_LT(motion.speed(), 0.05) << "noise is no speed";
  EXPECT_NEAR(motion.rest(now), 2.1, 0.15);
}

TEST(VehicleMotion, SeesThatAVehicleCreeps) {
  VehicleMotion motion;
  double now = 0.0;
  for (int i = 0; i < 200; ++i, now += 0.1) motion.update({0.01 * i, 0.0, 0.0}, now);
  EXPECT_LT(motion.rest(now), 1.0);
}

TEST(VehicleMotion, TellsNoSpeedAcrossAGapInThePoses) {
  VehicleMotion motion;
  motion.update({0.0, 0.0, 0.0}, 0.0);
  motion.update({1000.0, 0.0, 0.0}, 60.0);
  EXPECT_EQ(motion.speed(), 0.0);
}

TEST(EndError, IsInTheDirectionInWhichTheVehicleArrives) {
  ReferencePoint end;
  end.x = 10.0;
  end.heading = M_PI / 2.0;
  const EndError beyond = endError({10.0, 0.3, M_PI / 2.0}, end);
  EXPECT_NEAR(beyond.along, 0.3, 1e-9);
  EXPECT_NEAR(beyond.across, 0.0, 1e-9);
  end.direction = Direction::kReverse;
  EXPECT_NEAR(endError({10.0, 0.3, M_PI / 2.0}, end).along, -0.3, 1e-9);
  EXPECT_NEAR(endError({9.8, 0.0, M_PI / 2.0 + 0.1}, end).across, 0.2, 1e-9);
  EXPECT_NEAR(endError({9.8, 0.0, M_PI / 2.0 + 0.1}, end).heading, 0.1, 1e-9);
}

TEST(Arrival, IsWithinEachToleranceAndRefusesWhatIsBeyondOne) {
  const ArrivalParams params;
  EXPECT_TRUE(isWithin({0.4, -0.4, 0.1}, params));
  EXPECT_FALSE(isWithin({0.6, 0.0, 0.0}, params));
  EXPECT_FALSE(isWithin({0.0, -0.6, 0.0}, params));
  EXPECT_FALSE(isWithin({0.0, 0.0, 0.3}, params));
}

}  // namespace
}  // namespace external_command
