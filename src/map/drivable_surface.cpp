// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/drivable_surface.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <optional>
#include <utility>

#include "core/boost_point.h"
#include "external_command/core/error.h"

namespace external_command {

namespace {

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<Point2d, false, true>;
using BoostRing = BoostPolygon::ring_type;
using BoostMultiPolygon = bg::model::multi_polygon<BoostPolygon>;

using BoostLine = bg::model::linestring<Point2d>;

constexpr double kTouching = 0.3;      // by which every lane is widened [m]
constexpr double kSimplified = 0.03;   // tolerance of the centre line [m]
constexpr int kPointsPerCircle = 16;   // of rounded ends and bends
constexpr double kMinHoleArea = 0.05;  // smaller holes are slits between lanes [m^2]
constexpr double kLostArea = 0.01;     // of a union that shows that it failed [m^2]
constexpr double kNudge = 0.011;  // edges that nearly coincide are where unions fail; a little wider, they do not [m]
constexpr int kNudges = 5;

/// Coordinates relative to `center`, where they are small.
BoostPolygon toBoost(const std::vector<Point2d>& points, const Point2d& center) {
  BoostPolygon polygon;
  for (const Point2d& point : points) polygon.outer().push_back(point - center);
  bg::correct(polygon);
  return polygon;
}

std::vector<Point2d> fromBoost(const BoostRing& ring, const Point2d& center) {
  std::vector<Point2d> points;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) points.push_back(center + ring[i]);
  return points;
}

/// The lane within `radius` of `s`, widened to `half_width`, with round ends.
BoostMultiPolygon widened(const Lane& lane, double s, double radius, double half_width, const Point2d& center) {
  const double from = std::max(0.0, s - radius), to = std::min(lane.length(), s + radius);
  BoostMultiPolygon surface;
  if (to - from < kTouching) return surface;
  BoostLine dense, line;
  const Polyline part = lane.center.slice(from, to);
  for (const Point2d& point : part.points()) dense.push_back(point - center);
  bg::simplify(dense, line, kSimplified);
  using namespace bg::strategy::buffer;
  bg::buffer(line, surface, distance_symmetric<double>(half_width), side_straight(), join_round(kPointsPerCircle),
             end_round(kPointsPerCircle), point_circle(kPointsPerCircle));
  return surface;
}

/// `whole` and the widened lane; nullopt where the library fails.
std::optional<BoostMultiPolygon> unionOf(const BoostMultiPolygon& whole, const Lane& lane, double s, double radius,
                                         double half_width, const Point2d& center) {
  try {
    const BoostMultiPolygon piece = widened(lane, s, radius, half_width, center);
    BoostMultiPolygon joined;
    bg::union_(whole, piece, joined);
    const bool is_whole = bg::area(joined) > std::max(bg::area(whole), bg::area(piece)) - kLostArea;
    return is_whole ? std::optional<BoostMultiPolygon>(std::move(joined)) : std::nullopt;
  } catch (const InternalError&) {  // of its assertions
    return std::nullopt;
  }
}

/// Adds the widened lane to `whole`.
void add(const Lane& lane, double s, double radius, double extra, const Point2d& center, const CancelToken& cancel,
         BoostMultiPolygon* whole) {
  for (int i = 0; i < kNudges; ++i) {
    cancel.throwIfCancelled();
    const double half_width = lane.widthAt(s) / 2.0 + extra + i * kNudge;
    auto joined = unionOf(*whole, lane, s, radius, half_width, center);
    if (!joined) continue;
    *whole = *std::move(joined);
    return;
  }
}

/// The part of `whole` that holds `core`, which was one of its pieces.
const BoostPolygon& partWith(const Polygon& core, const BoostMultiPolygon& whole, const Point2d& center) {
  Point2d inside = Point2d::Zero();
  for (const Point2d& corner : core.points()) inside += (corner - center) / static_cast<double>(core.points().size());
  const auto holds = [&](const BoostPolygon& part) { return bg::within(inside, part.outer()); };
  const auto found = std::find_if(whole.begin(), whole.end(), holds);
  if (found != whole.end()) return *found;
  return *std::max_element(whole.begin(), whole.end(),
                           [](const BoostPolygon& a, const BoostPolygon& b) { return bg::area(a) < bg::area(b); });
}

}  // namespace

Surface drivableSurface(const HdMap& map, const Polygon& core, const Point2d& center, const SurfaceParams& params,
                        const CancelToken& cancel) {
  BoostMultiPolygon whole;
  whole.push_back(toBoost(core.points(), center));
  LaneQuery query;
  query.max_distance = params.radius;
  for (const LaneMatch& near : map.lanesWithin(center, query)) {
    const Lane& lane = map.lane(near.lane);
    add(lane, near.frenet.s, params.radius, kTouching, center, cancel, &whole);
    const bool is_close = near.frenet.distance < params.gap_radius;
    if (is_close && params.gap > kTouching)
      add(lane, near.frenet.s, params.gap_radius, params.gap, center, cancel, &whole);
  }
  if (whole.empty()) throw InternalError("lanes and area have no common surface");
  const BoostPolygon& part = partWith(core, whole, center);
  Surface surface{Polygon(fromBoost(part.outer(), center), "the surface of lanes and area"), {}};
  for (const BoostRing& hole : part.inners()) {
    if (std::abs(bg::area(hole)) < kMinHoleArea) continue;
    surface.holes.emplace_back(fromBoost(hole, center), "what lies between the lanes");
  }
  return surface;
}

}  // namespace external_command
