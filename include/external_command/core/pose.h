// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace external_command {

/// A position in the plane [m], in the map frame (ENU) unless a name says otherwise.
using Point2d = Eigen::Vector2d;

/// A position [m] and a heading [rad], counter-clockwise from +x.
struct Pose2d {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;

  Point2d position() const { return {x, y}; }
  bool isFinite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(heading); }
};

/// False for a point that is not finite, or beyond any projection of the Earth: the squares of such numbers overflow.
inline bool isPlausible(const Point2d& point) {
  constexpr double kMaxCoordinate = 1e8;  // [m]
  return (point.array().abs() < kMaxCoordinate).all();
}

/// The same angle in [-pi, pi].
inline double normalizeAngle(double angle) { return std::remainder(angle, 2.0 * M_PI); }

/// Smallest turn from `from` to `to`, in [-pi, pi], positive to the left.
inline double angleBetween(double from, double to) { return normalizeAngle(to - from); }

/// z of the cross product: positive where `b` lies to the left of `a`.
inline double cross(const Point2d& a, const Point2d& b) { return a.x() * b.y() - a.y() * b.x(); }

inline Point2d unitVector(double heading) { return {std::cos(heading), std::sin(heading)}; }

inline double headingOf(const Point2d& direction) { return std::atan2(direction.y(), direction.x()); }

/// `local`, given in the frame of `frame`, in the frame that `frame` is given in.
inline Pose2d compose(const Pose2d& frame, const Pose2d& local) {
  const double c = std::cos(frame.heading), s = std::sin(frame.heading);
  return {frame.x + c * local.x - s * local.y, frame.y + s * local.x + c * local.y,
          normalizeAngle(frame.heading + local.heading)};
}

/// `pose` seen from `frame`: compose(frame, relativeTo(frame, pose)) == pose.
inline Pose2d relativeTo(const Pose2d& frame, const Pose2d& pose) {
  const double c = std::cos(frame.heading), s = std::sin(frame.heading);
  const double dx = pose.x - frame.x, dy = pose.y - frame.y;
  return {c * dx + s * dy, -s * dx + c * dy, normalizeAngle(pose.heading - frame.heading)};
}

}  // namespace external_command
