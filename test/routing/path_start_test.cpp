// SPDX-License-Identifier: Apache-2.0
// Reference paths that begin where the vehicle is.
#include <gtest/gtest.h>

#include <cmath>

#include "external_command/routing/reference_path.h"
#include "support/command_path_matcher.h"
#include "support/routing_world.h"

namespace external_command {
namespace {

///   a -----> b -----> 100 m each; the vehicle stands beside a, 20 m from its beginning
class VehicleBesideTheLane : public RoutingWorld {
 protected:
  VehicleBesideTheLane() { builder.lane("a", {0, 0}, {100, 0}).lane("b", {100, 0}, {200, 0}).follow({"a", "b"}); }

  ReferencePath pathFrom(const Pose2d& vehicle_pose, double goal_s = 90.0) {
    const Route route = drive({"a", std::max(0.0, vehicle_pose.x)}, {"b", goal_s});
    ReferencePath found = referencePath(map(), route, vehicle, path_params, {0.0, vehicle_pose});
    limitSpeeds(vehicle, &found.path);
    EXPECT_TRUE(isDrivableCommandPath(found.path, vehicle, vehicle_pose));
    return found;
  }

  VehicleParams vehicle;
  ReferencePathParams path_params;
};

TEST_F(VehicleBesideTheLane, BeginsAtTheVehicleAndMergesOntoTheCentreLine) {
  for (const double beside : {-1.5, -0.3, -0.01, 0.0, 0.004, 0.1, 0.8, 1.9}) {
    for (const double turned : {-0.5, -0.1, 0.0, 0.02, 0.3}) {
      SCOPED_TRACE(testing::Message() << beside << " m beside the lane, turned by " << turned << " rad");
      const ReferencePath found = pathFrom({20.0, beside, turned});
      EXPECT_TRUE(found.tight.empty());
      for (const ReferencePoint& point : found.path) EXPECT_TRUE(point.x < 60.0 || std::abs(point.y) < 0.05);
    }
  }
}

TEST_F(VehicleBesideTheLane, MergesGently) {
  for (const ReferencePoint& point : pathFrom({20.0, 0.5, 0.0}).path) EXPECT_LT(std::abs(point.kappa), 0.06);
}

TEST_F(VehicleBesideTheLane, BeginsBeforeTheLaneDoes) {
  const ReferencePath found = pathFrom({-1.5, 0.5, 0.05});
  EXPECT_TRUE(found.tight.empty());
  EXPECT_NEAR(found.path.back().s, 191.5, 0.3);
}

TEST_F(VehicleBesideTheLane, TellsWhereItCannotGetOntoTheLaneInTime) {
  const Route route = drive({"a", 98}, {"b", 1});
  const ReferencePath found = referencePath(map(), route, vehicle, path_params, {0.0, Pose2d{98.0, 1.9, 0.4}});
  EXPECT_FALSE(found.tight.empty());
  EXPECT_LT((found.path.back().pose().position() - Point2d(101.0, 0.0)).norm(), 1e-6);
}

TEST_F(VehicleBesideTheLane, StandsWhereItIsWhenItIsThereAlready) {
  const Route route = drive({"a", 20}, {"a", 20});
  const ReferencePath found = referencePath(map(), route, vehicle, path_params, {0.0, Pose2d{20.0, 0.4, 0.1}});
  ASSERT_EQ(found.path.size(), 2u);
  EXPECT_EQ(found.path.back().y, 0.4);
  EXPECT_EQ(found.path.back().s, 0.0);
}

}  // namespace
}  // namespace external_command
