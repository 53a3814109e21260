// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path_progress.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

/// A square lap of 160 m that ends where it begins.
std::shared_ptr<const Path> lap() {
  Path path;
  const double side = 40.0;
  for (int i = 0; i <= 320; ++i) {
    const double s = 0.5 * i;
    const int edge = std::min(3, static_cast<int>(s / side));
    const double along = s - edge * side;
    const Pose2d corner[] = {{0.0, 0.0, 0.0}, {side, 0.0, M_PI / 2}, {side, side, M_PI}, {0.0, side, -M_PI / 2}};
    const Pose2d pose = compose(corner[edge], {along, 0.0, 0.0});
    ReferencePoint point;
    point.x = pose.x;
    point.y = pose.y;
    point.heading = pose.heading;
    point.s = s;
    path.push_back(point);
  }
  return std::make_shared<const Path>(path);
}

TEST(PathProgress, DoesNotTakeTheEndOfALapForItsBegin) {
  const auto path = lap();
  PathProgress progress(path);
  progress.update(path->front().pose(), 0.0);
  EXPECT_EQ(progress.reached(), 0u);
  double now = 0.0;
  for (std::size_t i = 0; i < path->size(); i += 4) progress.update((*path)[i].pose(), now += 0.1);
  EXPECT_NEAR(progress.lengthLeft(), 0.0, 0.5);
  EXPECT_NEAR(progress.drivenLength(), 160.0, 0.5);
}

TEST(PathProgress, IgnoresPosesBesideThePath) {
  PathProgress progress(lap());
  progress.update({5.0, 20.0, 0.0}, 0.0);
  EXPECT_EQ(progress.reached(), 0u);
}

TEST(PathProgress, FindsTheVehicleAgainAfterItWasNotSeenForSomeSeconds) {
  const auto path = lap();
  PathProgress progress(path);
  progress.update(path->front().pose(), 0.0);
  progress.update((*path)[100].pose(), 3.0);
  EXPECT_EQ(progress.reached(), 100u);
}

TEST(PathProgress, CountsBetweenPointsAndNeverGoesBack) {
  const auto path = lap();
  PathProgress progress(path);
  double now = 0.0, last = 0.0;
  for (double s = 0.0; s < 39.0; s += 0.13) {
    progress.update({s, 0.3, 0.0}, now += 0.1);
    EXPECT_NEAR(progress.drivenLength(), s, 0.01);
    EXPECT_GE(progress.shareDone(), last);
    last = progress.shareDone();
  }
  progress.update({30.0, 0.0, 0.0}, now += 0.1);
  EXPECT_GE(progress.shareDone(), last);
  EXPECT_NEAR(progress.lengthLeft(), 160.0 - 39.0, 0.2);
}

TEST(PathProgress, IsDoneOnAPathWithoutLength) {
  const PathProgress progress(std::make_shared<const Path>(Path(2)));
  EXPECT_EQ(progress.lengthLeft(), 0.0);
  EXPECT_EQ(progress.shareDone(), 1.0);
}

}  // namespace
}  // namespace external_command
