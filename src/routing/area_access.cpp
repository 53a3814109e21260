// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/area_access.h"

#include <limits>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kStep = 1.0;  // along a lane [m]

double distanceTo(const Polygon& polygon, const Point2d& point) {
  return polygon.contains(point) ? 0.0 : polygon.distanceToBorder(point);
}

/// The first point of the lane that is nearest to the area.
LanePoint nearestPoint(const HdMap& map, LaneIndex lane, const Polygon& polygon, double from, double to,
                       double* distance) {
  LanePoint nearest{lane, from};
  *distance = std::numeric_limits<double>::infinity();
  for (double s = from; s <= to; s += kStep) {
    const double here = distanceTo(polygon, map.lane(lane).center.pointAt(s));
    if (here < *distance - 1e-3) {
      *distance = here;
      nearest.s = s;
    }
  }
  return nearest;
}

}  // namespace

std::vector<LanePoint> accessPoints(const HdMap& map, const Area& area, double max_distance) {
  std::vector<LanePoint> points;
  double distance = 0.0;
  for (const LaneOverlap& overlap : area.lanes) {
    if (!map.lane(overlap.lane).isDrivable()) continue;
    points.push_back(nearestPoint(map, overlap.lane, area.polygon, overlap.start_s, overlap.end_s, &distance));
  }
  if (!points.empty()) return points;

  const BoundingBox& box = area.polygon.box();
  LaneQuery query;
  query.max_distance = (box.max - box.min).norm() / 2.0 + max_distance;
  for (const LaneMatch& near : map.lanesWithin((box.min + box.max) / 2.0, query)) {
    const LanePoint point = nearestPoint(map, near.lane, area.polygon, 0.0, map.lane(near.lane).length(), &distance);
    if (distance <= max_distance) points.push_back(point);
  }
  if (!points.empty()) return points;
  throw OffMap(text("no lane gives access to area '", area.id, "': none overlaps it or comes within ",
                    metres(max_distance), " (~access_distance)"));
}

}  // namespace external_command
