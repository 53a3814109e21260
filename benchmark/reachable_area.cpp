// SPDX-License-Identifier: Apache-2.0
#include "reachable_area.h"

#include <algorithm>
#include <boost/geometry.hpp>

#include "../src/core/boost_point.h"

namespace external_command {
namespace benchmark {

namespace {

namespace bg = boost::geometry;
using Shape = bg::model::polygon<Point2d>;
using Shapes = bg::model::multi_polygon<Shape>;

constexpr std::size_t kPointsPerCircle = 128;

Shape shapeOf(const Ring& ring, const Point2d& origin) {
  Shape shape;
  for (const Point2d& point : ring) shape.outer().push_back(point - origin);
  bg::correct(shape);
  return shape;
}

Ring ringOf(const Shape::ring_type& ring, const Point2d& origin) {
  Ring result;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) result.push_back(origin + ring[i]);
  return result;
}

/// Holes may overlap each other and the border.
Shapes freeShapes(const CoverageCase& field, const Point2d& origin) {
  Shapes free;
  free.push_back(shapeOf(field.rings.at(0), origin));
  for (std::size_t i = 1; i < field.rings.size(); ++i) {
    Shapes rest;
    bg::difference(free, shapeOf(field.rings[i], origin), rest);
    free = std::move(rest);
  }
  return free;
}

Shapes grown(const Shapes& shapes, double distance) {
  namespace strategy = bg::strategy::buffer;
  Shapes result;
  bg::buffer(shapes, result, strategy::distance_symmetric<double>(distance), strategy::side_straight(),
             strategy::join_round(kPointsPerCircle), strategy::end_round(kPointsPerCircle),
             strategy::point_circle(kPointsPerCircle));
  return result;
}

}  // namespace

std::vector<Ring> reachableArea(const CoverageCase& field, const Point2d& start) {
  const Point2d origin = field.rings.at(0).at(0);
  const double width = std::max(field.vehicle.width, field.swath_width);
  const Shapes core = grown(freeShapes(field, origin), -width / 2.0);
  if (core.empty()) return {};
  const Point2d at = start - origin;
  const auto is_nearer = [&](const Shape& a, const Shape& b) { return bg::distance(at, a) < bg::distance(at, b); };
  const Shapes swept = grown(Shapes{*std::min_element(core.begin(), core.end(), is_nearer)}, field.swath_width / 2.0);
  std::vector<Ring> rings;
  for (const Shape& shape : swept) {
    rings.push_back(ringOf(shape.outer(), origin));
    for (const auto& hole : shape.inners()) rings.push_back(ringOf(hole, origin));
  }
  return rings;
}

}  // namespace benchmark
}  // namespace external_command
