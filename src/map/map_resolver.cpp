// SPDX-License-Identifier: Apache-2.0
#include "map_resolver.h"

#include "external_command/core/error.h"
#include "external_command/core/in_parallel.h"
#include "external_command/core/text.h"
#include "lane_checks.h"

namespace external_command {

namespace {

void shift(const Point2d& origin, std::vector<Point2d>* points) {
  for (Point2d& point : *points) point -= origin;
}

void shift(const Point2d& origin, MapData* data) {
  for (LaneData& lane : data->lanes) {
    shift(origin, &lane.center);
    shift(origin, &lane.left.points);
    shift(origin, &lane.right.points);
  }
  for (JunctionData& junction : data->junctions) shift(origin, &junction.polygon);
  for (ParkingSpaceData& space : data->parking_spaces) shift(origin, &space.polygon);
  for (AreaData& area : data->areas) shift(origin, &area.polygon);
}

void grow(const std::vector<Point2d>& points, BoundingBox* box) {
  for (const Point2d& point : points) {
    box->min = box->min.cwiseMin(point);
    box->max = box->max.cwiseMax(point);
  }
}

BoundingBox boxOf(const MapContent& map) {
  const Point2d first = map.lanes.front().center.points().front();
  BoundingBox box{first, first};
  for (const Lane& lane : map.lanes) {
    grow(lane.center.points(), &box);
    grow(lane.left.points, &box);
    grow(lane.right.points, &box);
  }
  for (const Junction& junction : map.junctions) grow(junction.polygon.points(), &box);
  for (const ParkingSpace& space : map.parking_spaces) grow(space.polygon.points(), &box);
  for (const Area& area : map.areas) grow(area.polygon.points(), &box);
  return box;
}

}  // namespace

MapContent resolve(MapData data, const Point2d& origin, const MapParams& params) {
  if (!origin.allFinite()) throw MapError("the map origin is not finite; give two coordinates in metres");
  MapContent map(params.keep_findings);
  map.file_digest = data.file_digest;
  map.version = std::move(data.version);
  map.projection = std::move(data.projection);
  map.origin = origin;
  if (!origin.isZero(0.0)) shift(origin, &data);
  const std::size_t stated = data.lanes.size();
  resolveLanes(&data, params, &map);
  if (map.lanes.empty()) {
    throw MapError(
        stated == 0 ? "the map has no lane in it"
                    : text("none of the map's ", stated, " lanes can be used: ", map.faults.warnings().front().what));
  }
  // Nothing refers to the lanes of the file any more, and to free a million of them takes a second.
  inParallel(2, [&](std::size_t part) {
    if (part == 0) {
      map.tree = LaneTree(map.lanes);
    } else {
      std::vector<LaneData>().swap(data.lanes);
    }
  });
  countMissingNeighbours(&map);
  resolveObjects(&data, &map);
  map.box = boxOf(map);
  map.warnings = map.faults.warnings();
  map.findings = map.faults.takeFindings();
  return map;
}

}  // namespace external_command
