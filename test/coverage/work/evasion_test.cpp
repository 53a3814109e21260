// SPDX-License-Identifier: Apache-2.0
#include "coverage/work/evasion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../sweeper.h"

namespace external_command {
namespace {

constexpr double kStep = 0.25;
const Pose2d kBegin{2.0, 10.0, 0.0};  // of a line of 36 m through the middle of a hall

Field hallWith(const std::vector<Polygon>& posts) {
  return Field(sweeper(), params(), {box(0, 0, 40, 20), posts}, std::nullopt, {});
}

std::vector<Work> swathsPast(const Field& field, double length = 36.0) {
  return evadingSwaths(field, kBegin, length, kStep);
}

/// Distance from the line at a place [m along it from x = 0], to the left of a vehicle that drives along x.
double asideAt(const Curve& way, double x) {
  double best = 1e9, aside = 0.0;
  for (const Pose2d& pose : posesAlong(way, 2.0, 0.05)) {
    if (std::abs(pose.x - x) < best) best = std::abs(pose.x - x), aside = pose.y - kBegin.y;
  }
  return aside;
}

TEST(EvadingSwaths, BendRoundAPostAndComeBack) {
  const Field field = hallWith({post(20.0, 10.2)});
  const std::vector<Work> works = swathsPast(field);
  ASSERT_EQ(works.size(), 1u);
  ASSERT_EQ(works[0].ways(), 2u) << "from either end";
  for (const std::size_t way : {0, 1}) {
    const Curve curve = works[0].curveOf(way);
    EXPECT_TRUE(field.isFree(curve));
    EXPECT_EQ(curve.gearChanges(), 0u);
    EXPECT_LT(asideAt(curve, 20.0), -0.5) << "on the side where there is less to go round, way " << way;
    EXPECT_NEAR(asideAt(curve, 12.0), 0.0, 1e-6);
    EXPECT_NEAR(asideAt(curve, 28.0), 0.0, 1e-6);
    EXPECT_LT(curve.length(), 36.0 + 1.0);
  }
}

TEST(EvadingSwaths, PassCloselyAndNotWithinTheMargin) {
  const CoverageArea area{box(0, 0, 40, 20), {post(20.0, 10.2)}};
  const CollisionChecker checker(sweeper(), 0.0, Region({area.outer, area.holes, std::nullopt, std::nullopt, {}}));
  const Curve way = swathsPast(hallWith(area.holes)).front().curveOf(0);
  double least = 10.0;
  for (const Pose2d& pose : posesAlong(way, 2.0, 0.05)) {
    least = std::min(least, checker.clearance({pose.x, pose.y, pose.heading}));
  }
  EXPECT_GE(least, params().margin - 0.01);
  EXPECT_LT(least, params().margin + 0.1);
}

TEST(EvadingSwaths, AreCutWhereThereIsNoRoomBeside) {
  std::vector<Polygon> fence;
  for (double y = 0.5; y < 20.0; y += 1.5) fence.push_back(post(20.0, y));
  const Field field = hallWith(fence);
  const std::vector<Work> works = swathsPast(field);
  ASSERT_EQ(works.size(), 2u);
  for (const Work& work : works) {
    for (std::size_t way = 0; way < work.ways(); ++way) {
      EXPECT_TRUE(field.isFree(work.curveOf(way)));
      EXPECT_EQ(work.curveOf(way).arcs.size(), 1u);
    }
  }
}

TEST(EvadingSwaths, ReturnToTheLineBetweenPostsThatAreFarApart) {
  const Curve way = swathsPast(hallWith({post(12.0, 10.2), post(28.0, 10.2)})).front().curveOf(0);
  EXPECT_NEAR(asideAt(way, 20.0), 0.0, 1e-6);
}

TEST(EvadingSwaths, StayBesideTheLineBetweenPostsThatAreNear) {
  const Field field = hallWith({post(18.0, 10.2), post(22.0, 10.2)});
  const Curve way = swathsPast(field).front().curveOf(0);
  EXPECT_TRUE(field.isFree(way));
  EXPECT_LT(asideAt(way, 20.0), -0.5);
}

TEST(EvadingSwaths, BeginBesideTheLineWithoutRoomBeforeAPost) {
  const Field field = hallWith({post(5.0, 10.2)});
  const std::vector<Work> works = swathsPast(field);
  ASSERT_EQ(works.size(), 1u);
  EXPECT_LT(works[0].startOf(0).y, 10.0 - 0.5);
  EXPECT_TRUE(field.isFree(works[0].curveOf(0)));
}

TEST(EvadingSwaths, AreStraightWithNothingInTheWay) {
  const std::vector<Work> works = swathsPast(hallWith({}));
  ASSERT_EQ(works.size(), 1u);
  EXPECT_EQ(works[0].curveOf(0).arcs.size(), 1u);
  EXPECT_NEAR(works[0].length(), 35.87, kStep) << "to where the nose is at the margin";
}

}  // namespace
}  // namespace external_command
