// SPDX-License-Identifier: Apache-2.0
#include "../../src/routing/path_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/polyline.h"

namespace external_command {
namespace {

constexpr double kStep = 0.5;
constexpr std::size_t kStraight = 40;

/// A straight, a bend of `angle` [rad] on a circle of `radius`, and a straight; `room` [m] to either side.
std::vector<FitPoint> bend(double radius, double angle, double room) {
  std::vector<FitPoint> places;
  Pose2d pose{5e5, 4e6, 0.3};  // map coordinates must not eat the digits
  const auto turning = static_cast<std::size_t>(std::ceil(radius * angle / kStep));
  for (std::size_t i = 0; i < 2 * kStraight + turning; ++i) {
    FitPoint place;
    place.base = pose.position();
    place.normal = unitVector(pose.heading + M_PI / 2.0);
    place.low = place.wished_low = -room;
    place.high = place.wished_high = room;
    places.push_back(place);
    const bool turns = i >= kStraight && i < kStraight + turning;
    const double turn = turns ? angle / static_cast<double>(turning) : 0.0;
    pose = compose(pose, {kStep * std::cos(turn / 2.0), kStep * std::sin(turn / 2.0), turn});
  }
  for (std::size_t i = 0; i < 3; ++i) places[i].fixed = places[places.size() - 1 - i].fixed = true;
  return places;
}

std::vector<Point2d> fitted(const std::vector<FitPoint>& places) {
  FitParams params;
  params.front = 0.0;
  PathFit fit(places, params);
  fit.run({});
  return fit.points();
}

double largestKappa(const std::vector<Point2d>& points) {
  double largest = 0.0;
  for (const double kappa : curvaturesOf(points)) largest = std::max(largest, std::abs(kappa));
  return largest;
}

double largestOffset(const std::vector<FitPoint>& places, const std::vector<Point2d>& points) {
  double largest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    largest = std::max(largest, std::abs((points[i] - places[i].base).dot(places[i].normal)));
  }
  return largest;
}

TEST(PathFit, LeavesAStraightWhereItIs) {
  const auto places = bend(10.0, 0.0, 1.0);
  EXPECT_LT(largestOffset(places, fitted(places)), 1e-6);
}

TEST(PathFit, WidensABendWhereThereIsRoom) {
  const auto places = bend(3.5, M_PI / 2.0, 1.0);
  const auto points = fitted(places);
  EXPECT_LT(largestKappa(points), 0.203);
  EXPECT_LT(largestOffset(places, points), 1.01);
}

TEST(PathFit, ChangesTheCurvatureNoFasterThanTheWheelsTurnWhereThereIsRoom) {
  const auto points = fitted(bend(8.0, M_PI / 2.0, 1.0));
  const std::vector<double> kappas = curvaturesOf(points);
  for (std::size_t i = 1; i < kappas.size(); ++i) EXPECT_LT(std::abs(kappas[i] - kappas[i - 1]), 0.105 * kStep) << i;
}

TEST(PathFit, StaysWithinItsLimitsWhereThereIsNoRoom) {
  const auto places = bend(2.5, M_PI, 0.2);
  const auto points = fitted(places);
  EXPECT_LT(largestOffset(places, points), 0.23);
  EXPECT_GT(largestKappa(points), 0.3);
}

TEST(PathFit, GoesBeyondWhatIsWishedOnlyForTheVehiclesSake) {
  auto places = bend(3.5, M_PI / 2.0, 1.0);
  for (FitPoint& place : places) place.wished_low = -0.1, place.wished_high = 0.1;
  EXPECT_LT(largestKappa(fitted(places)), 0.203);
  auto gentle = bend(20.0, M_PI / 2.0, 1.0);
  for (FitPoint& place : gentle) place.wished_low = -0.1, place.wished_high = 0.1;
  EXPECT_LT(largestOffset(gentle, fitted(gentle)), 0.12);
}

TEST(PathFit, HoldsFixedPlaces) {
  const auto places = bend(3.5, M_PI / 2.0, 1.0);
  const auto points = fitted(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].fixed) {
      EXPECT_EQ(points[i], places[i].base) << i;
    }
  }
}

TEST(PathFit, KeepsTheFrontOfALongVehicleInside) {
  const auto places = bend(10.0, M_PI / 2.0, 1.0);
  FitParams params;
  params.front = 6.0;  // swings out by 1.8 m on the centre line
  PathFit fit(places, params);
  fit.run({});
  const auto& points = fit.points();
  double out = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point2d front = points[i] + params.front * (points[i + 1] - points[i - 1]).normalized();
    double nearest = 1e9;
    for (const FitPoint& place : places) nearest = std::min(nearest, (front - place.base).norm());
    if (i + 20 < points.size()) out = std::max(out, nearest);
  }
  EXPECT_LT(out, 1.2);
}

TEST(PathFit, CanBeCancelled) {
  const CancelSource source;
  source.cancel();
  PathFit fit(bend(3.5, M_PI / 2.0, 1.0), {});
  EXPECT_THROW(fit.run(source.token()), Cancelled);
}

}  // namespace
}  // namespace external_command
