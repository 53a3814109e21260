// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path_borders.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kStep = 0.5;   // a shorter way has no sure direction: recorded points of a vehicle that stands [m]
constexpr double kSide = 0.01;  // of a border beside the line, which then lies to this side and not to that [m]

/// Points of the line from one to the next of which the direction of driving is sure.
std::vector<std::size_t> steps(const std::vector<Point2d>& points) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (chosen.empty() || (points[i] - points[chosen.back()]).norm() >= kStep) chosen.push_back(i);
  }
  return chosen;
}

bool isDrivenForward(const WaypointLine& line, std::size_t from, std::size_t to) {
  if (line.headings.size() != line.points.size()) return true;
  const Point2d way = line.points[to] - line.points[from];
  return way.dot(unitVector(line.headings[from])) > 0.0 && way.dot(unitVector(line.headings[to])) > 0.0;
}

/// Of `border` to the left of the ways that lead to a point and on from it, whichever it is nearer to.
double sideOf(const Point2d& border, const Point2d& point, const std::vector<Point2d>& ways) {
  double nearest = cross(ways.front(), border - point);
  for (const Point2d& way : ways) {
    const double side = cross(way, border - point);
    if (side * nearest <= 0.0) return 0.0;  // on different sides of a corner
    if (std::abs(side) < std::abs(nearest)) nearest = side;
  }
  return nearest;
}

template <class Condition>
std::optional<BorderSides> firstPlace(const WaypointLine& line, const PathBorders& borders, const Condition& isWanted) {
  const std::vector<std::size_t> chosen = steps(line.points);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    std::vector<Point2d> ways;
    bool is_forward = true;
    for (std::size_t to = std::max<std::size_t>(k, 1); to <= k + 1 && to < chosen.size(); ++to) {
      is_forward = is_forward && isDrivenForward(line, chosen[to - 1], chosen[to]);
      ways.push_back((line.points[chosen[to]] - line.points[chosen[to - 1]]).normalized());
    }
    if (ways.empty() || !is_forward) continue;
    const std::size_t i = chosen[k];
    const BorderSides sides{i, sideOf(borders.left[i], line.points[i], ways),
                            -sideOf(borders.right[i], line.points[i], ways)};
    if (isWanted(sides)) return sides;
  }
  return std::nullopt;
}

}  // namespace

std::optional<BorderSides> swappedBorders(const WaypointLine& line, const PathBorders& borders) {
  return firstPlace(line, borders,
                    [](const BorderSides& sides) { return sides.left < -kSide && sides.right < -kSide; });
}

std::optional<BorderSides> crossedBorder(const WaypointLine& line, const PathBorders& borders) {
  return firstPlace(line, borders,
                    [](const BorderSides& sides) { return (sides.left < -kSide) != (sides.right < -kSide); });
}

}  // namespace external_command
