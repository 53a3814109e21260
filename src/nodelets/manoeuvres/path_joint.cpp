// SPDX-License-Identifier: Apache-2.0
#include "path_joint.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/pose.h"

namespace external_command {

namespace {

constexpr double kRamps = 1.2;      ///< of the longest ramp, half of which lies on the path, as multiple
constexpr double kMostBend = 10.0;  ///< longer pieces of a lane are seldom arcs [m]

/// @param direction  in which the vehicle drives between the two points.
EndState passing(const Path& path, std::size_t point, std::size_t bend, Direction direction) {
  EndState state{direction, path[point].kappa};
  if (point == bend) return state;
  const double driven = path[point].s - path[bend].s;  // below 0 behind the point
  const double gear = signOf(direction);
  state.kappa = gear * angleBetween(path[bend].heading, path[point].heading) / driven;
  state.bend_from = path[bend].pose();
  state.bend_length = std::abs(driven);
  return state;
}

}  // namespace

double bendLength(const VehicleParams& vehicle, const FreeSpaceParams& params) {
  if (!params.continuous_curvature) return 0.0;
  return std::min(kRamps * vehicle.rampLength(params.manoeuvre_speed), kMostBend);
}

PathJoint leavingAt(const Path& path, std::size_t index, double length) {
  if (index == 0) return {index, index, std::nullopt};
  const Direction direction = path[index].direction;
  std::size_t bend = index;
  while (bend > 0 && path[bend].direction == direction && path[index].s - path[bend].s < length) --bend;
  return {index, bend, passing(path, index, bend, direction)};
}

PathJoint joiningAt(const Path& path, std::size_t index, double length) {
  if (index + 1 == path.size()) return {index, index, std::nullopt};
  const Direction direction = path[index + 1].direction;
  std::size_t bend = index;
  while (bend + 1 < path.size() && path[bend + 1].direction == direction && path[bend].s - path[index].s < length)
    ++bend;
  return {index, bend, passing(path, index, bend, direction)};
}

}  // namespace external_command
