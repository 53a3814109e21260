// SPDX-License-Identifier: Apache-2.0
#include "geometry.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace bg = boost::geometry;
using shapes::Ring;
using shapes::Shape;
using shapes::Shapes;

namespace {

constexpr int kPointsPerCircle = 72;
constexpr double kSpeck = 1e-3;  // [m^2] smaller pieces are rounding
constexpr int kAttempts = 4;
constexpr std::size_t kMostAtOnce = 1000;  ///< corners of a border that is moved in one piece
constexpr std::size_t kPiece = 50;         ///< sides of the pieces otherwise

/// What lies within `distance` of `from`; without a rim as wide where that is negative.
template <class Geometry>
Shapes roundBuffer(const Geometry& from, double distance) {
  namespace strategy = bg::strategy::buffer;
  Shapes result;
  bg::buffer(from, result, strategy::distance_symmetric<double>(distance), strategy::side_straight(),
             strategy::join_round(kPointsPerCircle), strategy::end_round(kPointsPerCircle),
             strategy::point_circle(kPointsPerCircle));
  return result;
}

/// What lies within `distance` of a border of many corners: piece by piece, since all at once may take seconds in which
/// nobody is asked whether to go on.
Shapes bandAlong(const Ring& ring, double distance, const Checkpoint& checkpoint) {
  std::vector<Shapes> pieces;
  for (std::size_t first = 0; first + 1 < ring.size(); first += kPiece) {
    checkpoint();
    const auto last = static_cast<long>(std::min(first + kPiece + 1, ring.size()));
    const bg::model::linestring<Point2d> piece(ring.begin() + static_cast<long>(first), ring.begin() + last);
    pieces.push_back(roundBuffer(piece, distance));
  }
  return unionOf(std::move(pieces), checkpoint);
}

/// nullopt where the library finds that it has gone wrong, as with outlines whose walls are thin.
std::optional<Shapes> buffered(const Shape& from, double distance, const Checkpoint& checkpoint) {
  try {
    if (from.outer().size() <= kMostAtOnce) return roundBuffer(from, distance);
    const Shapes band = bandAlong(from.outer(), std::abs(distance), checkpoint);
    return distance < 0.0 ? difference(only(from), band) : unionOf({only(from), band}, checkpoint);
  } catch (const InternalError&) {
    return std::nullopt;
  }
}

void dropSpecks(Shapes* of) {
  for (Shape& shape : *of) {
    auto& holes = shape.inners();
    const auto tiny = [](const Ring& ring) { return std::abs(bg::area(ring)) < kSpeck; };
    holes.erase(std::remove_if(holes.begin(), holes.end(), tiny), holes.end());
  }
  const auto tiny = [](const Shape& shape) { return bg::area(shape) < kSpeck; };
  of->erase(std::remove_if(of->begin(), of->end(), tiny), of->end());
}

/// A new border lies `distance` away from the old one, and the area changes by no more than the old and the new
/// perimeter can account for.
bool isPlausible(const Shape& before, const Shapes& after, double distance) {
  const double width = std::abs(distance), tolerance = 0.02 * width + 1e-3;
  const double change = (distance > 0.0 ? 1.0 : -1.0) * (bg::area(after) - bg::area(before));
  const double most = std::max(bg::perimeter(before), bg::perimeter(after)) * width + M_PI * width * width;
  if (change < -kSpeck || change > 1.05 * most + kSpeck) return false;
  const bg::model::linestring<Point2d> border(before.outer().begin(), before.outer().end());
  for (const Shape& shape : after) {
    const std::size_t stride = std::max<std::size_t>(1, shape.outer().size() / 40);
    for (std::size_t i = 0; i < shape.outer().size(); i += stride) {
      if (std::abs(bg::distance(shape.outer()[i], border) - width) > tolerance) return false;
    }
  }
  return true;
}

/// What lies within a ring, grown or shrunk. Checked by area and distance, since some releases of the library lose a
/// part now and then: tried again with a slightly different distance.
Shapes grownRing(Ring ring, double distance, const Checkpoint& checkpoint) {
  Shape shape;
  shape.outer() = std::move(ring);
  if (distance == 0.0) return only(shape);
  std::optional<Shapes> last;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const double factor = 1.0 + 1e-3 * attempt * (attempt % 2 == 0 ? 1 : -1);
    checkpoint();
    std::optional<Shapes> result = buffered(shape, distance * factor, checkpoint);
    if (!result) continue;
    dropSpecks(&*result);
    last = std::move(result);
    if (isPlausible(shape, *last, distance)) break;
  }
  if (last) return *std::move(last);
  throw InternalError(text("a border of ", shape.outer().size() - 1, " corners cannot be moved by ", metres(distance),
                           "; give it fewer corners, or a little more room between them"));
}

/// Ring by ring, which takes far less time than all at once where there are many holes.
Shapes withRingsMoved(const Shape& shape, double border_outwards, double holes_outwards, const Checkpoint& checkpoint) {
  std::vector<Shapes> holes;
  for (const auto& hole : shape.inners()) {
    checkpoint();
    holes.push_back(grownRing(Ring(hole.rbegin(), hole.rend()), holes_outwards, checkpoint));
  }
  const Shapes whole = grownRing(Ring(shape.outer().begin(), shape.outer().end()), border_outwards, checkpoint);
  return holes.empty() ? whole : difference(whole, unionOf(std::move(holes), checkpoint));
}

}  // namespace

std::vector<Point2d> pointsOf(const Ring& ring) {
  std::vector<Point2d> points = ring;
  if (!points.empty()) points.pop_back();
  return points;
}

Shape shapeOf(const std::vector<Point2d>& points) {
  Shape shape;
  shape.outer().assign(points.begin(), points.end());
  bg::correct(shape);
  return shape;
}

Shapes only(const Shape& shape) {
  Shapes all;
  all.push_back(shape);
  return all;
}

double areaOf(const Shapes& of) { return bg::area(of); }

double areaOf(const Ring& ring) { return bg::area(ring); }

Ring hullOf(const Shape& shape) {
  Ring hull;
  bg::convex_hull(shape, hull);
  return hull;
}

Ring simplified(const Ring& ring, double distance) {
  Ring result;
  bg::simplify(ring, result, distance);
  return result.size() > 3 ? result : ring;
}

/// In pairs, then those in pairs, so that most unions are of small shapes.
Shapes unionOf(std::vector<Shapes> all, const Checkpoint& checkpoint) {
  if (all.empty()) return {};
  while (all.size() > 1) {
    std::vector<Shapes> fewer((all.size() + 1) / 2);
    for (std::size_t i = 0; i < fewer.size(); ++i) {
      checkpoint();
      if (2 * i + 1 < all.size()) {
        bg::union_(all[2 * i], all[2 * i + 1], fewer[i]);
      } else {
        fewer[i] = std::move(all[2 * i]);
      }
    }
    all = std::move(fewer);
  }
  return std::move(all.front());
}

double perimeterOf(const Shape& shape) { return bg::perimeter(shape.outer()); }

double borderLengthOf(const Shape& shape) { return bg::perimeter(shape); }

Shapes difference(const Shapes& from, const Shapes& what) {
  Shapes result;
  bg::difference(from, what, result);
  dropSpecks(&result);
  return result;
}

Shapes intersection(const Shapes& a, const Shapes& b) {
  Shapes result;
  bg::intersection(a, b, result);
  dropSpecks(&result);
  return result;
}

Shapes grown(const Shapes& of, double distance, const Checkpoint& checkpoint) {
  std::vector<Shapes> parts;
  for (const Shape& shape : of) parts.push_back(withRingsMoved(shape, distance, -distance, checkpoint));
  return unionOf(std::move(parts), checkpoint);
}

Shapes inset(const Shapes& area, double border, double holes, const Checkpoint& checkpoint) {
  Shapes result;
  for (const Shape& shape : area) {
    for (Shape& part : withRingsMoved(shape, -border, holes, checkpoint)) result.push_back(std::move(part));
  }
  return result;
}

Shapes partAt(const Shapes& of, const Point2d& point) {
  Shapes best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Shape& shape : of) {
    const double distance = bg::distance(point, shape);
    if (distance >= nearest) continue;
    nearest = distance;
    best = only(shape);
  }
  return best;
}

}  // namespace external_command
