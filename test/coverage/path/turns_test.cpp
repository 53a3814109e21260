// SPDX-License-Identifier: Apache-2.0
#include "coverage/path/turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "../sweeper.h"

namespace external_command {
namespace {

/// A yard of 40 x 20 m.
class Yard {
 public:
  explicit Yard(const std::vector<Polygon>& walls = {})
      : field_(sweeper(), params(), {box(0.0, 0.0, 40.0, 20.0), walls}, kStart, CancelToken()) {}

  const Field& field() const { return field_; }
  /// In the frame of the field.
  Pose2d pose(double x, double y, double heading) const {
    return {x - field_.origin().x(), y - field_.origin().y(), heading};
  }

 private:
  Field field_;
};

double costOf(const Field& field, const Curve& curve) {
  return curve.length() + field.gearPrice() * curve.gearChangesBetween();
}

void expectLeads(const Field& field, const Curve& curve, const Pose2d& from, const Pose2d& to) {
  EXPECT_NEAR((curve.start.position() - from.position()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((curve.end().position() - to.position()).norm(), 0.0, 1e-6);
  EXPECT_NEAR(angleBetween(curve.end().heading, to.heading), 0.0, 1e-6);
  EXPECT_TRUE(field.isFree(curve));
  for (const ArcSegment& arc : curve.arcs) EXPECT_LE(std::abs(arc.kappa) * field.radius(), 1.0 + 1e-9);
}

/// Of all turns whose ends are shifted by so many small steps.
double leastCostByTrying(const Field& field, const Pose2d& from, const Pose2d& to) {
  const double step = 0.05 * field.radius();
  double least = std::numeric_limits<double>::infinity();
  for (int i = -50; i <= 50; ++i) {
    for (int j = -50; j <= 50; ++j) {
      const Pose2d begin = advance(from, ArcSegment{i * step, 0.0}), end = advance(to, ArcSegment{-j * step, 0.0});
      for (const SteeringCurve& turn : turnsWithoutObstacles(begin, end, field.radius(), field.gearPrice())) {
        if (turn.cost > least) break;
        Curve curve{from, {}};
        curve.append({i * step, 0.0});
        curve.append(turn.arcs);
        curve.append({j * step, 0.0});
        if (costOf(field, curve) < least && field.isFree(curve)) least = costOf(field, curve);
      }
    }
  }
  return least;
}

TEST(ShortTurn, IsTheCheapestWhereThereIsRoom) {
  const Yard yard;
  const Pose2d from = yard.pose(20.0, 8.0, 0.0), to = yard.pose(20.0, 13.0, M_PI);
  const auto turn = shortTurn(yard.field(), from, to);
  ASSERT_TRUE(turn);
  expectLeads(yard.field(), *turn, from, to);
  EXPECT_NEAR(turn->length(), M_PI * yard.field().radius(), 1e-6) << "half a circle";
}

TEST(ShortTurn, IsNoneBeforeAWall) {
  const Yard yard;
  EXPECT_FALSE(shortTurn(yard.field(), yard.pose(37.5, 8.0, 0.0), yard.pose(37.5, 13.0, M_PI)));
}

TEST(ShiftedTurn, IsHardlyDearerThanTheCheapestOfAllShifts) {
  const Yard open, walled({box(33.0, 11.0, 40.0, 11.4)});
  const auto expectCheap = [](const Yard& yard, double offset) {
    const Pose2d from = yard.pose(37.4, 8.0, 0.0), to = yard.pose(36.1, 8.0 + offset, M_PI);
    const auto turn = shiftedTurn(yard.field(), from, to);
    ASSERT_TRUE(turn) << offset;
    expectLeads(yard.field(), *turn, from, to);
    EXPECT_LE(costOf(yard.field(), *turn), 1.02 * leastCostByTrying(yard.field(), from, to)) << offset;
  };
  for (const double offset : {1.6, 2.4, 3.2, 4.0, 5.0}) expectCheap(open, offset);
  expectCheap(walled, 1.6);
}

TEST(ShiftedTurn, IsNoneToTheOtherSideOfAWall) {
  const Yard yard({box(0.0, 11.0, 40.0, 11.4)});
  EXPECT_FALSE(shiftedTurn(yard.field(), yard.pose(36.0, 8.0, 0.0), yard.pose(36.0, 14.0, M_PI)));
}

}  // namespace
}  // namespace external_command
