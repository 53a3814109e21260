// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "external_command/core/pose.h"

namespace external_command {
namespace benchmark {

/// How a vehicle moves from one pose to another at constant rates: on one arc, where it does not slip.
struct Twist {
  double forward = 0.0;   ///< [m]
  double sideways = 0.0;  ///< to the left [m]
  double turn = 0.0;      ///< [rad]

  double distance() const { return std::hypot(forward, sideways); }
};

inline Twist twistBetween(const Pose2d& from, const Pose2d& to) {
  const Pose2d chord = relativeTo(from, to);
  const double half = chord.heading / 2.0, scale = std::abs(half) < 1e-6 ? 1.0 : half / std::tan(half);
  return {scale * chord.x + half * chord.y, scale * chord.y - half * chord.x, chord.heading};
}

/// The pose after `share` of the motion.
inline Pose2d along(const Pose2d& from, const Twist& twist, double share) {
  const double turn = share * twist.turn;
  const bool is_straight = std::abs(turn) < 1e-9;
  const double sine = is_straight ? 1.0 : std::sin(turn) / turn;
  const double cosine = is_straight ? turn / 2.0 : (1.0 - std::cos(turn)) / turn;
  return compose(from, {share * (sine * twist.forward - cosine * twist.sideways),
                        share * (cosine * twist.forward + sine * twist.sideways), turn});
}

}  // namespace benchmark
}  // namespace external_command
