// SPDX-License-Identifier: Apache-2.0
#include "support/map_builder.h"

#include <cmath>
#include <stdexcept>

namespace external_command {

namespace {

constexpr double kPointSpacing = 5.0;  // [m]

double lengthOf(const std::vector<Point2d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// `points` moved sideways by `offset` [m], to the left where positive.
std::vector<Point2d> moved(const std::vector<Point2d>& points, double offset) {
  const std::vector<double> headings = headingsOf(points);
  std::vector<Point2d> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.push_back(points[i] + offset * unitVector(headings[i] + M_PI / 2.0));
  }
  return result;
}

}  // namespace

MapBuilder& MapBuilder::lane(const std::string& id, const Point2d& from, const Point2d& to) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kPointSpacing)));
  std::vector<Point2d> points;
  for (int i = 0; i <= steps; ++i) points.push_back(from + (to - from) * i / steps);
  return lane(id, points);
}

MapBuilder& MapBuilder::lane(const std::string& id, const std::vector<Point2d>& points) {
  LaneData lane;
  lane.id = id;
  lane.center = points;
  lane.length = lengthOf(points);
  lane.speed_limit = kSpeedLimit;
  lane.left.points = moved(points, kLaneWidth / 2.0);
  lane.right.points = moved(points, -kLaneWidth / 2.0);
  lane.left.types = lane.right.types = {{0.0, BoundaryType::kSolidWhite}};
  lane.left_widths = lane.right_widths = {{0.0, kLaneWidth / 2.0}, {lane.length, kLaneWidth / 2.0}};
  data_.lanes.push_back(lane);
  return *this;
}

MapBuilder& MapBuilder::arc(const std::string& id, const Pose2d& start, double radius, double angle) {
  const int steps = std::max(8, static_cast<int>(std::ceil(std::abs(angle) * radius)));
  const double side = angle > 0.0 ? 1.0 : -1.0;
  const Point2d center = start.position() + side * radius * unitVector(start.heading + M_PI / 2.0);
  std::vector<Point2d> points;
  for (int i = 0; i <= steps; ++i) {
    points.push_back(center - side * radius * unitVector(start.heading + M_PI / 2.0 + angle * i / steps));
  }
  return lane(id, points);
}

MapBuilder& MapBuilder::follow(std::initializer_list<std::string> ids) {
  for (auto id = ids.begin(); id + 1 < ids.end(); ++id) {
    (*this)[*id].successors.push_back(*(id + 1));
    (*this)[*(id + 1)].predecessors.push_back(*id);
  }
  return *this;
}

MapBuilder& MapBuilder::beside(std::initializer_list<std::string> ids) {
  for (auto id = ids.begin(); id + 1 < ids.end(); ++id) {
    LaneData &left = (*this)[*id], &right = (*this)[*(id + 1)];
    left.right_forward.push_back(right.id);
    right.left_forward.push_back(left.id);
    left.right.types = right.left.types = {{0.0, BoundaryType::kDottedWhite}};
  }
  return *this;
}

MapBuilder& MapBuilder::opposite(const std::string& a, const std::string& b) {
  (*this)[a].left_reverse.push_back(b);
  (*this)[b].left_reverse.push_back(a);
  return *this;
}

MapBuilder& MapBuilder::road(const std::string& id, std::initializer_list<std::string> lanes,
                             const std::string& junction) {
  data_.roads.push_back({id, {{"1", lanes}}, junction});
  return *this;
}

MapBuilder& MapBuilder::junction(const std::string& id, const std::vector<Point2d>& polygon) {
  data_.junctions.push_back({id, polygon});
  return *this;
}

MapBuilder& MapBuilder::parkingSpace(const std::string& id, const Pose2d& middle, double length, double width,
                                     std::initializer_list<std::string> lanes) {
  ParkingSpaceData space;
  space.id = id;
  space.heading = middle.heading;
  space.has_heading = true;
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    space.polygon.push_back(compose(middle, {x * length, y * width, 0.0}).position());
  }
  for (const std::string& lane : lanes) {
    OverlapData overlap;
    overlap.id = "overlap_" + id + "_" + lane;
    overlap.objects = {{lane, true, 0.0, lengthOf((*this)[lane].center)}, {id, false, 0.0, 0.0}};
    space.overlaps.push_back(overlap.id);
    (*this)[lane].overlaps.push_back(overlap.id);
    data_.overlaps.push_back(overlap);
  }
  data_.parking_spaces.push_back(space);
  return *this;
}

MapBuilder& MapBuilder::area(const std::string& id, const std::vector<Point2d>& polygon, const std::string& name) {
  data_.areas.push_back({id, name, polygon, {}});
  return *this;
}

LaneData& MapBuilder::operator[](const std::string& lane_id) {
  for (LaneData& lane : data_.lanes) {
    if (lane.id == lane_id) return lane;
  }
  throw std::out_of_range("no lane " + lane_id);
}

std::shared_ptr<const HdMap> MapBuilder::build(const Point2d& origin) const {
  return std::make_shared<const HdMap>(data_, origin);
}

LaneIndex laneIndex(const HdMap& map, const std::string& id) {
  const auto index = map.findLane(id);
  if (!index) throw std::out_of_range("no lane " + id);
  return *index;
}

}  // namespace external_command
