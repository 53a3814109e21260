// SPDX-License-Identifier: Apache-2.0
#include "support/path_matchers.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/text.h"
#include "support/reference_clearance.h"

namespace external_command {

namespace {

constexpr double kTurnSlack = 1e-5;    ///< of a step [rad]
constexpr double kSweepStep = 0.01;    ///< most that a corner moves between two poses looked at [m]
constexpr double kEndDistance = 1e-3;  ///< [m]
constexpr double kEndTurn = 0.01 * M_PI / 180.0;

/// The twist that leads from a pose to the next.
struct Twist {
  double forward, sideways, turn;
};

Twist twistBetween(const Pose2d& from, const Pose2d& to) {
  const Pose2d seen = relativeTo(from, to);
  const double half = seen.heading / 2.0;
  const double scale = std::abs(half) < 1e-9 ? 1.0 : half / std::tan(half);
  return {scale * seen.x + half * seen.y, -half * seen.x + scale * seen.y, seen.heading};
}

Pose2d along(const Pose2d& from, const Twist& twist, double fraction) {
  const double half = 0.5 * twist.turn * fraction;
  const double chord = twist.forward * fraction * (std::abs(half) < 1e-9 ? 1.0 : std::sin(half) / half);
  return compose(from, {chord * std::cos(half), chord * std::sin(half), 2.0 * half});
}

testing::AssertionResult stepIsDrivable(const ReferencePoint& from, const ReferencePoint& to,
                                        const VehicleParams& vehicle, const PathLimits& limits) {
  const Twist twist = twistBetween(from.pose(), to.pose());
  const double length = std::abs(twist.forward);
  const double gear = signOf(to.direction);
  if (gear * twist.forward < -1e-6) return testing::AssertionFailure() << "moves against its gear";
  if (length > limits.max_gap + 1e-6) return testing::AssertionFailure() << "jumps by " << length << " m";
  if (std::abs(twist.sideways) > limits.slip) {
    return testing::AssertionFailure() << "moves sideways by " << twist.sideways << " m";
  }
  if (std::abs(twist.turn) > limits.curvature * vehicle.maxKappa() * length + kTurnSlack) {
    return testing::AssertionFailure() << "turns by " << twist.turn << " rad in " << length << " m";
  }
  if (std::abs(to.s - from.s - length) > 1e-4) {
    return testing::AssertionFailure() << "s grows by " << to.s - from.s << " m in " << length << " m";
  }
  if (length > 1e-3 && std::abs(to.kappa) > limits.curvature * vehicle.maxKappa()) {
    return testing::AssertionFailure() << "has kappa " << to.kappa;
  }
  return testing::AssertionSuccess();
}

}  // namespace

testing::AssertionResult isDrivable(const Path& path, const VehicleParams& vehicle, const PathLimits& limits) {
  if (path.empty()) return testing::AssertionFailure() << "the path is empty";
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto step = stepIsDrivable(path[i - 1], path[i], vehicle, limits);
    if (!step)
      return testing::AssertionFailure() << "point " << i << " " << at(path[i].pose()) << " " << step.message();
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult staysClear(const Path& path, const VehicleParams& vehicle, const Region& region,
                                    double clearance) {
  const double reach = std::hypot(vehicle.wheelbase + vehicle.front_overhang, vehicle.width / 2.0);
  double skip = 0.0;  // what the corners may move before anything can be met
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Pose2d from = path[i == 0 ? 0 : i - 1].pose();
    const Twist twist = twistBetween(from, path[i].pose());
    const double moved = std::abs(twist.forward) + reach * std::abs(twist.turn);
    const int pieces = std::max(1, static_cast<int>(std::ceil(moved / kSweepStep)));
    for (int piece = 1; piece <= pieces; ++piece) {
      skip -= moved / pieces;
      if (skip > 0.0) continue;
      const Pose2d pose = along(from, twist, static_cast<double>(piece) / pieces);
      const double distance = referenceClearance(vehicle, pose, region);
      if (distance < clearance) {
        return testing::AssertionFailure() << "at " << at(pose) << " an obstacle is " << distance << " m away";
      }
      skip = distance - clearance;
    }
  }
  if (!region.axleBounds()) return testing::AssertionSuccess();
  for (const ReferencePoint& point : path) {
    const Point2d axle = point.pose().position();
    if ((axle.array() < region.axleBounds()->min.array() - 1e-6).any() ||
        (axle.array() > region.axleBounds()->max.array() + 1e-6).any()) {
      return testing::AssertionFailure() << "at " << at(axle) << " the rear axle is out of its bounds";
    }
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult joins(const Path& path, const Pose2d& start, const Pose2d& goal) {
  if (path.empty()) return testing::AssertionFailure() << "the path is empty";
  const auto misses = [](const Pose2d& pose, const Pose2d& wanted) {
    return (pose.position() - wanted.position()).norm() > kEndDistance ||
           std::abs(angleBetween(pose.heading, wanted.heading)) > kEndTurn;
  };
  if (misses(path.front().pose(), start)) {
    return testing::AssertionFailure() << "begins at " << at(path.front().pose()) << " instead of " << at(start);
  }
  if (misses(path.back().pose(), goal)) {
    return testing::AssertionFailure() << "ends at " << at(path.back().pose()) << " instead of " << at(goal);
  }
  return testing::AssertionSuccess();
}

}  // namespace external_command
