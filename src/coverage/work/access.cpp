// SPDX-License-Identifier: Apache-2.0
#include "access.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kStep = 0.15;  ///< between places tried [turning radii]

/// @param gear  1 to drive on from the pose, -1 for where the vehicle may have come from.
bool hasRoom(const Field& field, const Pose2d& pose, double gear) {
  const double half = M_PI * field.radius(), kappa = field.vehicle().maxKappa();
  return field.isFree(Curve{pose, {{gear * half, kappa}}}) || field.isFree(Curve{pose, {{gear * half, -kappa}}});
}

}  // namespace

Curve accessiblePart(const Field& field, const Curve& line) {
  if (field.params().reverse_to_turn) return line;
  const double length = line.length(), step = kStep * field.radius();
  double from = 0.0, to = length;
  while (from < to && !hasRoom(field, poseAt(line, from), -1.0)) from += step;
  while (from < to && !hasRoom(field, poseAt(line, to), 1.0)) to -= step;
  return from < to ? partOf(line, from, to) : line;
}

}  // namespace external_command
