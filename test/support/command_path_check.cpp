// SPDX-License-Identifier: Apache-2.0
#include "support/command_path_check.h"

#include <cmath>

#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kSamePlace = 1e-3;  // [m]
constexpr double kSlack = 1.02;      // of limits of the sampled path
constexpr double kTurnSlack = 0.03;  // [rad]

bool stopsAt(const Path& path, std::size_t i) {
  return i + 1 == path.size() || (i > 0 && path[i + 1].direction != path[i].direction);
}

std::string goesOn(const ReferencePoint& from, const ReferencePoint& to, const CommandPathLimits& limits) {
  const double gear = signOf(to.direction);
  const Pose2d seen = relativeTo(from.pose(), to.pose());
  const double chord = seen.position().norm(), rise = to.s - from.s;
  if (chord > limits.max_gap) return text("lies ", chord, " m from the one before");
  if (!(rise >= 0.97 * chord - kSamePlace && rise <= 1.2 * chord + kSamePlace)) {
    return text("has an s that rises by ", rise, " m in ", chord, " m");
  }
  const double told = 0.5 * gear * (from.kappa + to.kappa) * rise;
  const double jump = 0.5 * std::abs(to.kappa - from.kappa) * rise;
  if (std::abs(seen.heading - told) > kTurnSlack + jump) {
    return text("turns by ", seen.heading, " rad; the curvature says ", told);
  }
  const Point2d ahead = gear * unitVector(0.5 * seen.heading);
  if (chord > kSamePlace && seen.position().dot(ahead) < 0.0) return "moves against its gear";
  if (std::abs(cross(ahead, seen.position())) > 0.005 + 0.02 * chord) {
    return text("moves sideways by ", cross(ahead, seen.position()), " m");
  }
  return "";
}

std::string isAllowed(const Path& path, std::size_t i, const VehicleParams& vehicle, const CommandPathLimits& limits) {
  const ReferencePoint& point = path[i];
  if (!point.pose().isFinite() || !std::isfinite(point.kappa) || !std::isfinite(point.speed)) {
    return "is not finite";
  }
  const bool forward = point.direction == Direction::kForward;
  if (point.speed > kSlack * (forward ? vehicle.max_speed : vehicle.max_reverse_speed)) {
    return text("has the limit ", point.speed, " m/s");
  }
  if (point.speed * point.speed * std::abs(point.kappa) > kSlack * vehicle.max_lateral_acceleration) {
    return text("is passed at ", point.speed, " m/s with curvature ", point.kappa);
  }
  if (limits.curvature && std::abs(point.kappa) > kSlack * vehicle.maxKappa()) {
    return text("has the curvature ", point.kappa);
  }
  if (stopsAt(path, i) != (point.speed == 0.0)) {
    return text("has the limit ", point.speed, " m/s; a stop is ", stopsAt(path, i) ? "due" : "not due");
  }
  return "";
}

std::string canBeFollowed(const ReferencePoint& from, const ReferencePoint& to, const VehicleParams& vehicle) {
  const double change = to.speed * to.speed - from.speed * from.speed;
  const double limit = change > 0.0 ? vehicle.max_acceleration : vehicle.max_deceleration;
  if (std::abs(change) <= 2.0 * kSlack * limit * (to.s - from.s) + 1e-6) return "";
  return text("asks for a change from ", from.speed, " to ", to.speed, " m/s in ", to.s - from.s, " m");
}

bool hasNoLength(const Path& path) {
  for (const ReferencePoint& point : path) {
    if ((point.pose().position() - path.front().pose().position()).norm() > kSamePlace) return false;
  }
  return true;
}

}  // namespace

std::string commandPathFault(const Path& path, const VehicleParams& vehicle, const std::optional<Pose2d>& start,
                             const CommandPathLimits& limits) {
  if (path.size() < 2) return text("the path has ", path.size(), " points");
  const Pose2d begin = path.front().pose();
  if (start && (begin.position() - start->position()).norm() > limits.start_distance) {
    return text("begins at ", at(begin), " instead of ", at(*start));
  }
  if (start && std::abs(angleBetween(begin.heading, start->heading)) > limits.start_turn) {
    return text("begins with the heading of ", at(begin), " instead of ", at(*start));
  }
  if (path.front().s != 0.0) return text("begins at s ", path.front().s);
  if (hasNoLength(path)) return "";
  for (std::size_t i = 0; i < path.size(); ++i) {
    std::string fault = isAllowed(path, i, vehicle, limits);
    if (fault.empty() && i > 0) fault = goesOn(path[i - 1], path[i], limits);
    if (fault.empty() && i > 0) fault = canBeFollowed(path[i - 1], path[i], vehicle);
    if (!fault.empty()) return text("point ", i, " of ", path.size(), ", ", at(path[i].pose()), ", ", fault);
  }
  return "";
}

}  // namespace external_command
