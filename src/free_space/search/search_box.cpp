// SPDX-License-Identifier: Apache-2.0
#include "search_box.h"

namespace external_command {

BoundingBox searchArea(const Scene& scene, const Query& query) {
  const FootprintIndex& index = scene.index;
  BoundingBox box{query.start.position().cwiseMin(query.goal.position()),
                  query.start.position().cwiseMax(query.goal.position())};
  if (index.extent().min.x() <= index.extent().max.x()) {
    box.min = box.min.cwiseMin(index.extent().min);
    box.max = box.max.cwiseMax(index.extent().max);
  }
  const Point2d room = Point2d::Constant(4.0 * scene.radius + 2.0 * index.box().half_length);
  return {(box.min - room).cwiseMax(index.axleBounds().min), (box.max + room).cwiseMin(index.axleBounds().max)};
}

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
