// SPDX-License-Identifier: Apache-2.0
#include "start_merge.h"

#include <algorithm>
#include <cmath>

#include "path_shape.h"

namespace external_command {

namespace {

constexpr double kShortest = 10.0;   // way over which a path merges [m]
constexpr double kLeftToEnd = 0.9;   // share of the whole path that it takes at most
constexpr double kSteering = 0.4;    // share of the vehicle's curvature that it takes
constexpr double kTurnPeak = 4.5;    // largest second derivative of turnShare(), about
constexpr double kSamePlace = 5e-3;  // [m]
constexpr double kSameTurn = 5e-3;   // [rad]

Point2d directionAt(const std::vector<Point2d>& line, std::size_t first) {
  const std::size_t next = std::min(first + 2, line.size() - 1);
  return (line[next] - line[first]).normalized();
}

/// From a slope of 1 at 0 to none at 1, 0 itself at both ends.
double turnShare(double t) { return t * (1.0 + t * t * (-6.0 + t * (8.0 - t * 3.0))); }

}  // namespace

bool isBeside(const Pose2d& start, const std::vector<Point2d>& line, std::size_t first) {
  const double turn = angleBetween(headingOf(directionAt(line, first)), start.heading);
  return (start.position() - line[first]).norm() > kSamePlace || std::abs(turn) > kSameTurn;
}

void mergeFrom(const Pose2d& start, std::size_t first, std::size_t last, double step, double max_kappa,
               std::vector<Point2d>* line) {
  const Point2d ahead = unitVector(start.heading), way = directionAt(*line, first);
  const Point2d offset = start.position() - (*line)[first];
  const double turn = std::abs(angleBetween(headingOf(way), start.heading));
  const double needed = std::max(std::sqrt(kQuinticPeak * offset.norm() / (kSteering * max_kappa)),
                                 kTurnPeak * turn / (kSteering * max_kappa));
  const double room = kLeftToEnd * step * static_cast<double>(last - first);
  const double length = std::max(step, std::min(std::max(kShortest, needed), room));
  for (std::size_t i = first; i < line->size(); ++i) {
    const double t = step * static_cast<double>(i - first) / length;
    if (t >= 1.0) break;
    (*line)[i] += (1.0 - quintic(t)) * offset + length * turnShare(t) * (ahead - way);
  }
  for (std::size_t i = 0; i < first; ++i) {
    (*line)[i] = start.position() - step * static_cast<double>(first - i) * ahead;
  }
}

}  // namespace external_command
