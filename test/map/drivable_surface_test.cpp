// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/drivable_surface.h"

#include <gtest/gtest.h>

#include "external_command/core/error.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

///            +------+
///            | core |
///   a -------+------+--> -- b ---->      c: 100 m away
class LaneBesideASpace : public testing::Test {
 protected:
  LaneBesideASpace() {
    builder.lane("a", {0, 0}, {20, 0}).lane("b", {20, 0}, {40, 0}).lane("c", {0, -100}, {40, -100}).follow({"a", "b"});
    map = builder.build();
  }

  MapBuilder builder;
  std::shared_ptr<const HdMap> map;
  const Polygon core{{{10.0, 1.5}, {16.0, 1.5}, {16.0, 5.0}, {10.0, 5.0}}, "core"};
};

TEST_F(LaneBesideASpace, IsOneSurfaceWithThem) {
  const Surface surface = drivableSurface(*map, core, {15.0, 0.0}, {});
  for (const Point2d& inside : {Point2d(13.0, 4.9), Point2d(1.0, 0.0), Point2d(20.0, 1.7), Point2d(39.0, -1.7)}) {
    EXPECT_TRUE(surface.outer.contains(inside)) << inside.transpose();
  }
  for (const Point2d& outside : {Point2d(13.0, 5.1), Point2d(5.0, 3.0), Point2d(20.0, -100.0)}) {
    EXPECT_FALSE(surface.outer.contains(outside)) << outside.transpose();
  }
  EXPECT_TRUE(surface.holes.empty());
}

TEST_F(LaneBesideASpace, IsNotMadeToTheEndWhenItIsCancelled) {
  const CancelSource cancel;
  cancel.cancel();
  EXPECT_THROW(drivableSurface(*map, core, {15.0, 0.0}, {}, cancel.token()), Cancelled);
}

}  // namespace
}  // namespace external_command
