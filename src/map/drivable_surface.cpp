// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/drivable_surface.h"

#include <algorithm>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/union.hpp>
#include <boost/geometry/algorithms/within.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <utility>

#include "external_command/core/error.h"

namespace external_command {

namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint, false, true>;
using BoostRing = BoostPolygon::ring_type;
using BoostMultiPolygon = bg::model::multi_polygon<BoostPolygon>;

constexpr double kPieceLength = 2.0;    // of a lane; a piece so short does not cross itself [m]
constexpr double kPieceOverlap = 0.05;  // between pieces: edges that only touch are where polygon unions fail [m]
constexpr double kMinHoleArea = 0.05;   // smaller holes are slits between lanes [m^2]

/// Coordinates relative to `center`, where they are small.
BoostPolygon toBoost(const std::vector<Point2d>& points, const Point2d& center) {
  BoostPolygon polygon;
  for (const Point2d& point : points) {
    polygon.outer().emplace_back(point.x() - center.x(), point.y() - center.y());
  }
  bg::correct(polygon);
  return polygon;
}

std::vector<Point2d> fromBoost(const BoostRing& ring, const Point2d& center) {
  std::vector<Point2d> points;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) points.push_back(center + Point2d(ring[i].x(), ring[i].y()));
  return points;
}

void add(const BoostPolygon& piece, BoostMultiPolygon* whole) {
  BoostMultiPolygon joined;
  bg::union_(*whole, piece, joined);
  *whole = std::move(joined);
}

/// The lane between `from` and `to`, a trapezium.
BoostPolygon pieceOf(const Lane& lane, double from, double to, double gap, const Point2d& center) {
  const Point2d a = lane.center.pointAt(from), b = lane.center.pointAt(to);
  const Point2d along = (b - a).normalized() * kPieceOverlap;
  const auto side_at = [&](double s, double lane_heading) -> Point2d {
    return (lane.widthAt(s) / 2.0 + gap) * unitVector(lane_heading + M_PI / 2.0);
  };
  const Point2d side_a = side_at(from, lane.center.headingAt(from)), side_b = side_at(to, lane.center.headingAt(to));
  return toBoost({a - along - side_a, b + along - side_b, b + along + side_b, a - along + side_a}, center);
}

void addLane(const Lane& lane, double s, const SurfaceParams& params, const Point2d& center, BoostMultiPolygon* whole) {
  const double first = std::max(0.0, s - params.radius);
  const double last = std::min(lane.length(), s + params.radius);
  for (double from = first; from < last - 1e-3; from += kPieceLength) {
    add(pieceOf(lane, from, std::min(from + kPieceLength, last), params.gap, center), whole);
  }
}

/// The part of `whole` that holds `core`, which was one of its pieces.
const BoostPolygon& partWith(const Polygon& core, const BoostMultiPolygon& whole, const Point2d& center) {
  Point2d inside = Point2d::Zero();
  for (const Point2d& corner : core.points()) inside += (corner - center) / static_cast<double>(core.points().size());
  const auto holds = [&](const BoostPolygon& part) {
    return bg::within(BoostPoint(inside.x(), inside.y()), part.outer());
  };
  const auto found = std::find_if(whole.begin(), whole.end(), holds);
  if (found != whole.end()) return *found;
  return *std::max_element(whole.begin(), whole.end(),
                           [](const BoostPolygon& a, const BoostPolygon& b) { return bg::area(a) < bg::area(b); });
}

}  // namespace

Surface drivableSurface(const HdMap& map, const Polygon& core, const Point2d& center, const SurfaceParams& params) {
  BoostMultiPolygon whole;
  whole.push_back(toBoost(core.points(), center));
  LaneQuery query;
  query.max_distance = params.radius;
  for (const LaneMatch& near : map.lanesWithin(center, query)) {
    addLane(map.lane(near.lane), near.frenet.s, params, center, &whole);
  }
  if (whole.empty()) throw InternalError("lanes and area have no common surface");
  const BoostPolygon& part = partWith(core, whole, center);
  Surface surface{Polygon(fromBoost(part.outer(), center), "the surface of lanes and area"), {}};
  for (const BoostRing& hole : part.inners()) {
    if (std::abs(bg::area(hole)) < kMinHoleArea) continue;
    surface.holes.emplace_back(fromBoost(hole, center), "a hole between the lanes");
  }
  return surface;
}

}  // namespace external_command
