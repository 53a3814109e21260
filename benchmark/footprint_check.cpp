// SPDX-License-Identifier: Apache-2.0
#include "footprint_check.h"

#define BOOST_ALLOW_DEPRECATED_HEADERS  // those that the index itself includes

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <limits>

#include "../src/core/boost_point.h"

namespace external_command {
namespace benchmark {

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using Box = bg::model::box<Point2d>;
using Segment = bg::model::segment<Point2d>;

struct Edge {
  Point2d a, b;
  std::size_t ring;
};
using Entry = std::pair<Segment, std::size_t>;

}  // namespace

struct FootprintCheck::Borders {
  explicit Borders(const std::vector<Ring>& rings) : ring_count(rings.size()) {
    std::vector<Entry> entries;
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
      const Ring& points = rings[ring];
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Point2d &a = points[i], &b = points[(i + 1) % points.size()];
        entries.emplace_back(Segment(a, b), edges.size());
        edges.push_back({a, b, ring});
        right = std::max(right, a.x());
      }
    }
    tree = decltype(tree)(entries);
  }

  /// Calls `visit` for each edge that meets the box, until it returns true.
  /// @return whether it did.
  template <class Visit>
  bool any(const Point2d& low, const Point2d& high, const Visit& visit) const {
    const auto last = tree.qend();
    for (auto entry = tree.qbegin(bgi::intersects(Box(low, high))); entry != last; ++entry) {
      if (visit(edges[entry->second])) return true;
    }
    return false;
  }

  std::vector<Edge> edges;
  std::size_t ring_count;
  double right = -std::numeric_limits<double>::infinity();
  bgi::rtree<Entry, bgi::rstar<16>> tree;
};

FootprintCheck::FootprintCheck(const CoverageCase& field, double tolerance)
    : borders_(std::make_unique<const Borders>(field.rings)) {
  const VehicleParams& vehicle = field.vehicle;
  low_ = Point2d(tolerance - vehicle.rear_overhang, tolerance - vehicle.width / 2.0);
  high_ = Point2d(vehicle.wheelbase + vehicle.front_overhang - tolerance, vehicle.width / 2.0 - tolerance);
  radius_ = low_.cwiseAbs().cwiseMax(high_.cwiseAbs()).norm();
}

FootprintCheck::~FootprintCheck() = default;

bool FootprintCheck::isInside(const Pose2d& pose) const {
  if (!holds(pose.position())) return false;
  const Point2d reach(radius_, radius_);
  return !borders_->any(pose.position() - reach, pose.position() + reach,
                        [&](const Edge& edge) { return touches(edge.a, edge.b, pose); });
}

double FootprintCheck::freeDistance(const Pose2d& pose) const {
  const Point2d position = pose.position();
  const auto nearest = borders_->tree.qbegin(bgi::nearest(position, 1));
  const Edge& edge = borders_->edges[nearest->second];
  return std::max(0.0, (nearestOnSegment(position, edge.a, edge.b) - position).norm() - radius_);
}

/// Inside the border and outside all holes, each by the number of edges to the right.
bool FootprintCheck::holds(const Point2d& point) const {
  std::vector<bool> is_in(borders_->ring_count, false);
  borders_->any(point, Point2d(borders_->right + 1.0, point.y()), [&](const Edge& edge) {
    const bool is_above = edge.a.y() > point.y();
    if (is_above == (edge.b.y() > point.y())) return false;
    const bool is_left = cross(edge.b - edge.a, point - edge.a) > 0.0;  // of the edge as it runs from a to b
    if (is_left != is_above) is_in[edge.ring] = !is_in[edge.ring];
    return false;
  });
  return is_in[0] && std::find(is_in.begin() + 1, is_in.end(), true) == is_in.end();
}

/// Clips the edge to the footprint (Y.-D. Liang and B. Barsky, 1984): true where something is left.
bool FootprintCheck::touches(const Point2d& a, const Point2d& b, const Pose2d& pose) const {
  const Point2d ahead = unitVector(pose.heading), aside(-ahead.y(), ahead.x());
  const Point2d from(ahead.dot(a - pose.position()), aside.dot(a - pose.position()));
  const Point2d way(ahead.dot(b - a), aside.dot(b - a));
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0.0) {
      if (from[axis] < low_[axis] || from[axis] > high_[axis]) return false;
      continue;
    }
    const double at_low = (low_[axis] - from[axis]) / way[axis], at_high = (high_[axis] - from[axis]) / way[axis];
    enter = std::max(enter, std::min(at_low, at_high));
    leave = std::min(leave, std::max(at_low, at_high));
  }
  return enter < leave;
}

}  // namespace benchmark
}  // namespace external_command
