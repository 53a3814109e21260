// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kSamePoint = 1e-6;  // [m]
constexpr double kSlowest = 1e-9;    // that is no stop: the square of less may be lost [m/s]
constexpr double kNoTurn = 1e-9;     // of the wheels [rad]

double stepLength(const ReferencePoint& from, const ReferencePoint& to) {
  return std::hypot(to.x - from.x, to.y - from.y);
}

/// Points that end one leg and begin the next: the gear changes after them.
bool isCusp(const Path& path, std::size_t i) {
  return i > 0 && i + 1 < path.size() && path[i].direction != path[i + 1].direction;
}

/// Length of the circular arc over the chord from `from` to `to`.
double arcLength(const ReferencePoint& from, const ReferencePoint& to) {
  const double half = 0.5 * std::abs(angleBetween(from.heading, to.heading));
  const double chord = stepLength(from, to);
  return half < 1e-6 ? chord : chord * half / std::sin(half);
}

/// limitSteering() for two points that follow each other.
void limitStep(const VehicleParams& vehicle, ReferencePoint* before, ReferencePoint* after) {
  if (before->direction != after->direction) return;
  const double speed = steeringSpeed(vehicle, *before, *after);
  before->speed = std::min(before->speed, speed);
  after->speed = std::min(after->speed, speed);
}

}  // namespace

Path join(const Path& first, const Path& second) {
  if (first.empty()) return second;
  Path joined = first;
  if (first.size() == 1 && !second.empty()) joined.front().direction = second.front().direction;
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (i == 0 && stepLength(first.back(), second[0]) < 1e-3) continue;
    joined.push_back(second[i]);
  }
  setArcLengths(&joined);
  return joined;
}

Path join(const Path& first, const Path& second, const VehicleParams& vehicle) {
  Path joined = join(first, second);
  const std::size_t seam = first.size();  // its first point that is not of `first`
  if (seam == 0 || seam == joined.size()) return joined;
  limitStep(vehicle, &joined[seam - 1], &joined[seam]);
  return joined;
}

double steeringSpeed(const VehicleParams& vehicle, const ReferencePoint& from, const ReferencePoint& to) {
  const double turned = std::abs(std::atan(vehicle.wheelbase * to.kappa) - std::atan(vehicle.wheelbase * from.kappa));
  return vehicle.max_steering_rate * std::max(to.s - from.s, kSamePoint) / std::max(turned, kNoTurn);
}

void limitSteering(const VehicleParams& vehicle, Path* path) {
  for (std::size_t i = 1; i < path->size(); ++i) limitStep(vehicle, &(*path)[i - 1], &(*path)[i]);
}

void setArcLengths(Path* path) {
  double s = 0.0;
  for (std::size_t i = 0; i < path->size(); ++i) {
    if (i > 0) s += arcLength((*path)[i - 1], (*path)[i]);
    (*path)[i].s = s;
  }
}

void setCurvatures(Path* path) {
  Path& points = *path;
  const auto turnRate = [&](std::size_t from, std::size_t to) {
    const double length = stepLength(points[from], points[to]);
    const double turn = angleBetween(points[from].heading, points[to].heading);
    return length < kSamePoint ? 0.0 : turn / arcLength(points[from], points[to]);
  };
  for (std::size_t i = 0; i < points.size() && points.size() > 1; ++i) {
    // A cusp belongs to the leg that arrives there; the next leg must not bend it.
    const bool ends_leg = i + 1 == points.size() || isCusp(points, i);
    const std::size_t from = i == 0 ? i : i - 1;
    const std::size_t to = ends_leg ? i : i + 1;
    const double sign = signOf(points[to].direction);
    points[i].kappa = sign * turnRate(from, to);
  }
}

void limitSpeeds(const VehicleParams& vehicle, Path* path) {
  Path& points = *path;
  std::vector<double> squares(points.size());  // of the speeds: braking and speeding up change them evenly by distance
  const double forward = vehicle.max_speed * vehicle.max_speed;
  const double reverse = vehicle.max_reverse_speed * vehicle.max_reverse_speed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double kappa = std::abs(points[i].kappa);
    const double cap = std::max(points[i].speed, kSlowest);
    squares[i] = std::min(cap * cap, points[i].direction == Direction::kForward ? forward : reverse);
    if (kappa > 1e-6) squares[i] = std::min(squares[i], vehicle.max_lateral_acceleration / kappa);
    if (isCusp(points, i)) squares[i] = 0.0;
  }
  if (!points.empty()) squares.back() = 0.0;
  const auto reachable = [&](std::size_t other, std::size_t i, double acceleration) {
    return squares[other] + 2.0 * acceleration * std::abs(points[i].s - points[other].s);
  };
  for (std::size_t i = points.size(); i-- > 1;) {
    squares[i - 1] = std::min(squares[i - 1], reachable(i, i - 1, vehicle.max_deceleration));
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    squares[i] = std::min(squares[i], reachable(i - 1, i, vehicle.max_acceleration));
  }
  for (std::size_t i = 0; i < points.size(); ++i) points[i].speed = std::sqrt(squares[i]);
}

double reverseLength(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].direction == Direction::kReverse) length += path[i].s - path[i - 1].s;
  }
  return length;
}

unsigned gearChanges(const Path& path) {
  unsigned changes = 0;
  for (std::size_t i = 2; i < path.size(); ++i) changes += path[i].direction != path[i - 1].direction;
  return changes;
}

}  // namespace external_command
