// SPDX-License-Identifier: Apache-2.0
#include "path_quality.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/polyline.h"
#include "support/command_path_check.h"

namespace external_command {

namespace {

constexpr double kTolerance = 1.03;  // of the sampled curvature
constexpr double kReach = 12.0;      // in which lanes are looked for [m]

}  // namespace

double PathQuality::excessAt(const Point2d& point, double heading) const {
  LaneQuery query;
  query.max_distance = kReach;
  query.heading = heading;
  query.max_heading_difference = M_PI / 2.0;
  double excess = kReach;
  for (const LaneMatch& match : map_.lanesWithin(point, query)) {
    const Lane& lane = map_.lane(match.lane);
    const double half = match.frenet.l > 0.0 ? lane.leftWidthAt(match.frenet.s) : lane.rightWidthAt(match.frenet.s);
    excess = std::min(excess, match.frenet.distance - half);
  }
  return excess;
}

void PathQuality::add(Path path, bool told) {
  ++paths_;
  limitSpeeds(vehicle_, &path);
  CommandPathLimits limits;
  limits.curvature = false;
  const std::string fault = commandPathFault(path, vehicle_, std::nullopt, limits);
  if (!fault.empty() && faulty_++ == 0) first_fault_ = fault;
  std::vector<Point2d> points;
  for (const ReferencePoint& point : path) points.push_back(point.pose().position());
  double kappa = 0.0;
  for (const double value : curvaturesOf(points)) kappa = std::max(kappa, std::abs(value));
  largest_kappa_ = std::max(largest_kappa_, kappa);
  const bool is_over = kappa > kTolerance * vehicle_.maxKappa();
  over_limit_ += is_over;
  untold_ += is_over && !told;
  for (const ReferencePoint& point : path) {
    largest_offset_ = std::max(largest_offset_, excessAt(point.pose().position(), point.heading));
    for (const Point2d& corner : footprintAt(vehicle_, point.pose(), 0.0)) {
      largest_excess_ = std::max(largest_excess_, excessAt(corner, point.heading));
    }
  }
}

double PathQuality::shareOverLimit() const {
  return paths_ == 0 ? 0.0 : static_cast<double>(over_limit_) / static_cast<double>(paths_);
}

double PathQuality::shareUntold() const {
  return paths_ == 0 ? 0.0 : static_cast<double>(untold_) / static_cast<double>(paths_);
}

}  // namespace external_command
