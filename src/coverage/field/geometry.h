// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <vector>

#include "core/boost_point.h"
#include "external_command/core/cancel_token.h"
#include "external_command/core/pose.h"

namespace external_command {

struct CoverageArea;

/// Shapes with holes, borders counter-clockwise, holes clockwise (what is free lies to the left of every ring), closed.
/// Only geometry.cpp includes the algorithms of Boost.Geometry, which are slow to compile.
namespace shapes {
using Ring = boost::geometry::model::ring<Point2d, false, true>;
using Shape = boost::geometry::model::polygon<Point2d, false, true>;
using Shapes = boost::geometry::model::multi_polygon<Shape>;
}  // namespace shapes

/// The points of a closed ring, the first not repeated.
std::vector<Point2d> pointsOf(const shapes::Ring& ring);

/// The shape without holes within `points`, which may be in either order.
shapes::Shape shapeOf(const std::vector<Point2d>& points);

/// `shape` alone.
shapes::Shapes only(const shapes::Shape& shape);

double areaOf(const shapes::Shapes& shapes);  ///< [m^2]

double perimeterOf(const shapes::Shape& shape);  ///< of its outer ring [m]

double borderLengthOf(const shapes::Shape& shape);  ///< of all its rings [m]

double areaOf(const shapes::Ring& ring);  ///< [m^2], positive for a border

/// The convex hull, as a border.
shapes::Ring hullOf(const shapes::Shape& shape);

/// The ring without the points that lie within `distance` [m] of the line between their neighbours.
shapes::Ring simplified(const shapes::Ring& ring, double distance);

/// This and all below throw InternalError where Boost.Geometry finds that it has gone wrong.
shapes::Shapes unionOf(std::vector<shapes::Shapes> all, const Checkpoint& checkpoint);

shapes::Shapes difference(const shapes::Shapes& from, const shapes::Shapes& what);
shapes::Shapes intersection(const shapes::Shapes& a, const shapes::Shapes& b);

/// Grown by `distance` [m] all round, or shrunk where that is negative; round corners.
shapes::Shapes grown(const shapes::Shapes& shapes, double distance, const Checkpoint& checkpoint);

/// The area with its border moved inwards by `border` and its holes grown by `holes` [m], neither negative.
shapes::Shapes inset(const shapes::Shapes& area, double border, double holes, const Checkpoint& checkpoint);

/// The one of `shapes` that holds `point` or is nearest to it; empty if there is none.
shapes::Shapes partAt(const shapes::Shapes& shapes, const Point2d& point);

}  // namespace external_command
