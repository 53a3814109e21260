// SPDX-License-Identifier: Apache-2.0
#include "nodelets/manoeuvres/path_joint.h"

#include <gtest/gtest.h>

#include "external_command/motion/reeds_shepp.h"

namespace external_command {
namespace {

constexpr double kSpacing = 0.5;  // [m]

/// Forward along a bend of 20 m, 10 m back along the same, 10 m forward again.
Path toAndFro() { return sampleArcs({3.0, 2.0, 0.4}, {{20.0, 0.05}, {-10.0, 0.05}, {10.0, 0.05}}, kSpacing); }

std::size_t at(double s) { return static_cast<std::size_t>(s / kSpacing); }

/// Driving on from `bend_from` as the state tells ends at the point, or begins there.
void expectMeets(const Path& path, const PathJoint& joint, bool is_before) {
  ASSERT_TRUE(joint.state);
  const Pose2d from = is_before ? joint.state->bend_from : path[joint.point].pose();
  const Pose2d to = is_before ? path[joint.point].pose() : joint.state->bend_from;
  const double gear = signOf(joint.state->direction);
  const Pose2d end = advance(from, ArcSegment{gear * joint.state->bend_length, joint.state->kappa});
  EXPECT_NEAR((end.position() - to.position()).norm(), 0.0, 1e-6);
  EXPECT_NEAR(angleBetween(end.heading, to.heading), 0.0, 1e-6);
}

TEST(PathJoint, TakesInThePathBeforeWhereItIsLeft) {
  const Path path = toAndFro();
  const PathJoint joint = leavingAt(path, at(10.0), 1.7);
  EXPECT_EQ(joint.bend, at(8.0));
  EXPECT_NEAR(joint.state->kappa, 0.05, 1e-9);
  expectMeets(path, joint, true);
}

TEST(PathJoint, TakesInThePathBehindWhereItIsJoined) {
  const Path path = toAndFro();
  const PathJoint joint = joiningAt(path, at(10.0), 1.7);
  EXPECT_EQ(joint.bend, at(12.0));
  expectMeets(path, joint, false);
}

TEST(PathJoint, KnowsTheGear) {
  const Path path = toAndFro();
  for (const double s : {20.0, 25.0}) {
    const PathJoint joint = joiningAt(path, at(s), 1.0);
    EXPECT_EQ(joint.state->direction, Direction::kReverse);
    expectMeets(path, joint, false);
  }
  expectMeets(path, leavingAt(path, at(30.0), 1.0), true);
}

TEST(PathJoint, DoesNotReachBeyondAGearChange) {
  const Path path = toAndFro();
  EXPECT_EQ(leavingAt(path, at(21.0), 5.0).bend, at(20.0));
  EXPECT_EQ(joiningAt(path, at(19.0), 5.0).bend, at(20.0));
}

TEST(PathJoint, LeavesThePathAsItIsWhereNoLengthIsWished) {
  const PathJoint joint = leavingAt(toAndFro(), at(10.0), 0.0);
  EXPECT_EQ(joint.bend, joint.point);
  EXPECT_EQ(joint.state->bend_length, 0.0);
}

TEST(PathJoint, BendsAsMuchAsTheSteeringTakes) {
  VehicleParams vehicle;
  const FreeSpaceParams params;
  const double usual = bendLength(vehicle, params);
  EXPECT_GT(usual, 0.3);
  EXPECT_LT(usual, 3.0);
  vehicle.max_steering_rate /= 2.0;
  EXPECT_NEAR(bendLength(vehicle, params), 2.0 * usual, 1e-9);
}

TEST(PathJoint, BendsAFewMetresAtMostHoweverSlowTheSteeringIs) {
  VehicleParams vehicle;
  vehicle.max_steering_rate = 0.001;
  EXPECT_EQ(bendLength(vehicle, FreeSpaceParams()), 10.0);
}

TEST(PathJoint, BendsNothingWhereSteeringNeedNotBeGradual) {
  FreeSpaceParams params;
  params.continuous_curvature = false;
  EXPECT_EQ(bendLength(VehicleParams(), params), 0.0);
}

TEST(PathJoint, IsAStandstillAtTheEndsOfThePath) {
  const Path path = toAndFro();
  EXPECT_FALSE(leavingAt(path, 0, 1.0).state);
  EXPECT_FALSE(joiningAt(path, path.size() - 1, 1.0).state);
  EXPECT_FALSE(joiningAt({path[0]}, 0, 1.0).state);
}

}  // namespace
}  // namespace external_command
