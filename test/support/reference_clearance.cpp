// SPDX-License-Identifier: Apache-2.0
#include "support/reference_clearance.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace external_command {

namespace {

using Ring = std::vector<Point2d>;

bool isInside(const Point2d& point, const Ring& ring) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    if ((ring[i].y() > point.y()) == (ring[j].y() > point.y())) continue;
    const Point2d edge = ring[j] - ring[i];
    if (point.x() < ring[i].x() + edge.x() * (point.y() - ring[i].y()) / edge.y()) inside = !inside;
  }
  return inside;
}

bool segmentsCross(const Point2d& a, const Point2d& b, const Point2d& c, const Point2d& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

double segmentDistance(const Point2d& a, const Point2d& b, const Point2d& c, const Point2d& d) {
  if (segmentsCross(a, b, c, d)) return 0.0;
  return std::min(std::min((nearestOnSegment(a, c, d) - a).norm(), (nearestOnSegment(b, c, d) - b).norm()),
                  std::min((nearestOnSegment(c, a, b) - c).norm(), (nearestOnSegment(d, a, b) - d).norm()));
}

double borderDistance(const Ring& one, const Ring& other) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = 0; j < other.size(); ++j) {
      best = std::min(best, segmentDistance(one[i], one[(i + 1) % one.size()], other[j], other[(j + 1) % other.size()]));
    }
  }
  return best;
}

double distanceToFilled(const Ring& footprint, const Ring& obstacle) {
  if (isInside(footprint[0], obstacle) || isInside(obstacle[0], footprint)) return 0.0;
  return borderDistance(footprint, obstacle);
}

double distanceToCells(const Ring& footprint, const OccupancyGrid& grid) {
  double best = std::numeric_limits<double>::infinity();
  const auto isBlocked = [&](long column, long row) {
    if (column < 0 || row < 0 || column >= long{grid.width} || row >= long{grid.height}) return grid.outside_is_blocked;
    const int value = grid.cells[static_cast<std::size_t>(row * long{grid.width} + column)];
    return value < 0 ? grid.unknown_is_blocked : value >= grid.blocked_from;
  };
  const long reach = 60;  // cells around the grid that stand for everything beyond it
  for (long row = -reach; row < long{grid.height} + reach; ++row) {
    for (long column = -reach; column < long{grid.width} + reach; ++column) {
      if (!isBlocked(column, row)) continue;
      Ring cell;
      for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        const Pose2d corner{grid.resolution * static_cast<double>(column + dx),
                            grid.resolution * static_cast<double>(row + dy), 0.0};
        cell.push_back(compose(grid.origin, corner).position());
      }
      best = std::min(best, distanceToFilled(footprint, cell));
    }
  }
  return best;
}

}  // namespace

double referenceClearance(const VehicleParams& vehicle, const Pose2d& pose, const Region& region) {
  const auto corners = footprintAt(vehicle, pose, 0.0);
  const Ring footprint(corners.begin(), corners.end());
  double best = std::numeric_limits<double>::infinity();
  if (region.drivable()) {
    const Ring& border = region.drivable()->points();
    best = isInside(footprint[0], border) ? borderDistance(footprint, border) : 0.0;
  }
  for (const Polygon& obstacle : region.nonDrivable()) {
    best = std::min(best, distanceToFilled(footprint, obstacle.points()));
  }
  if (region.grid()) best = std::min(best, distanceToCells(footprint, *region.grid()));
  return best;
}

}  // namespace external_command
