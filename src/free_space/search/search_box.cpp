// SPDX-License-Identifier: Apache-2.0
#include "search_box.h"

namespace external_command {

BoundingBox searchBox(const std::vector<Point2d>& points, double room, const BoundingBox& area) {
  BoundingBox box{points.front(), points.front()};
  for (const Point2d& point : points) {
    box.min = box.min.cwiseMin(point);
    box.max = box.max.cwiseMax(point);
  }
  const Point2d around = Point2d::Constant(room);
  return {(box.min - around).cwiseMax(area.min), (box.max + around).cwiseMin(area.max)};
}

}  // namespace external_command
