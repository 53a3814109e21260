// SPDX-License-Identifier: Apache-2.0
#include "made_fields.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "../test/support/vehicles.h"
#include "external_command/core/text.h"
#include "external_command/motion/collision_checker.h"

namespace external_command {
namespace benchmark {

namespace {

constexpr double kSweeperUpTo = 160.0;   ///< the longer side of the fields that a sweeper does [m]
constexpr double kStartClearance = 0.3;  // [m]
constexpr double kHoleClearance = 1.0;   ///< between holes, and to the border [m]

constexpr double kSweeperSwath = 1.6;  // [m]

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

double toMillimetres(double value) { return std::round(1e3 * value) / 1e3; }

/// All that is random is drawn here, so that each field depends on those before it, and on the seed.
class FieldMaker {
 public:
  explicit FieldMaker(unsigned seed) : engine_(seed) {}

  std::vector<CoverageCase> make(int random) {
    for (const double size : {60.0, 100.0, 300.0, 1000.0}) {
      add(text("rect_", size), {box(0.0, 0.0, size, 0.7 * size)});
    }
    for (const double size : {70.0, 120.0, 400.0}) addShapes(size);
    for (const double size : {90.0, 250.0}) addObstructed(size);
    for (int i = 0; i < random; ++i) addRandom(i);
    return std::move(fields_);
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

  void addShapes(double size) {
    const auto scaled = [&](Ring ring) {
      for (Point2d& point : ring) point *= size;
      return ring;
    };
    add(text("L_", size), {scaled({{0, 0}, {1, 0}, {1, 0.4}, {0.45, 0.4}, {0.45, 1}, {0, 1}})});
    add(text("U_", size),
        {scaled({{0, 0}, {1, 0}, {1, 0.8}, {0.7, 0.8}, {0.7, 0.3}, {0.3, 0.3}, {0.3, 0.8}, {0, 0.8}})});
    add(text("ring_", size), {scaled(box(0, 0, 1, 1)), scaled(box(0.3, 0.35, 0.7, 0.7))});
    add(text("slanted_", size), {scaled({{0, 0}, {0.7, 0.15}, {1, 0.6}, {0.25, 0.55}})});
    add(text("triangle_", size), {scaled({{0, 0}, {1, 0.1}, {0.35, 0.8}})});
  }

  /// What stands in the way has the same size in every field.
  void addObstructed(double size) {
    const double side = 0.45 * size, neck = size < kSweeperUpTo ? 3.0 : 7.5;
    add(text("neck_", size), {{{0, 0},
                               {side, 0},
                               {side, 0.3 * size - neck},
                               {0.55 * size, 0.3 * size - neck},
                               {0.55 * size, 0},
                               {size, 0},
                               {size, 0.6 * size},
                               {0.55 * size, 0.6 * size},
                               {0.55 * size, 0.3 * size + neck},
                               {side, 0.3 * size + neck},
                               {side, 0.6 * size},
                               {0, 0.6 * size}}});
    std::vector<Ring> columns = {box(0, 0, size, 0.66 * size)};
    for (double x = 9.3; x < size - 5.0; x += 17.1) {
      for (double y = 11.2; y < 0.66 * size - 5.0 && columns.size() < 25; y += 18.4) {
        columns.push_back(box(x - 0.4, y - 0.3, x + 0.4, y + 0.3));
      }
    }
    add(text("columns_", size), columns);
    add(text("walls_", size), {box(0, 0, size, 0.7 * size), box(0.2 * size, 0.34 * size, 0.7 * size, 0.34 * size + 0.4),
                               box(0.7 * size + 8.0, 0.1 * size, 0.7 * size + 8.5, 0.28 * size)});
  }

  /// At even angles around a centre, so that the polygon is simple.
  Ring star(const Point2d& centre, double radius, int corners, double roughness) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * M_PI * (i + uniform(-0.3, 0.3)) / corners;
      ring.push_back(centre + radius * uniform(1.0 - roughness, 1.0) * unitVector(angle));
    }
    return ring;
  }

  void addRandom(int number) {
    const double sizes[] = {80.0, 100.0, 150.0, 250.0, 500.0, 1000.0};
    const double size = sizes[number % 6];
    const int corners = pick(6, 20), holes = pick(0, 8);
    std::vector<Ring> rings = {star({0, 0}, size / 2.0, corners, uniform(0.2, 0.55))};
    for (int tries = 0; tries < 100 && static_cast<int>(rings.size()) <= holes; ++tries) {
      const bool is_pillar = pick(0, 3) == 0;
      const double radius = is_pillar ? uniform(0.3, 1.0) : std::min(25.0, uniform(0.02, 0.08) * size);
      const Point2d centre(uniform(-0.4, 0.4) * size, uniform(-0.4, 0.4) * size);
      if (isClear(centre, radius + kHoleClearance, rings)) rings.push_back(star(centre, radius, pick(4, 10), 0.4));
    }
    add(text("random_", number, "_", size, "_", corners, "v_", rings.size() - 1, "holes"), rings);
  }

  static bool isClear(const Point2d& centre, double radius, const std::vector<Ring>& rings) {
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const Polygon polygon(rings[i], "ring");
      if (polygon.contains(centre) != (i == 0) || polygon.distanceToBorder(centre) < radius) return false;
    }
    return true;
  }

  /// Every third field is turned.
  void add(const std::string& name, const std::vector<Ring>& rings) {
    CoverageCase field;
    field.name = name;
    const double turn = fields_.size() % 3 == 1 ? uniform(0.0, 2.0 * M_PI) : 0.0;
    for (const Ring& ring : rings) {
      field.rings.emplace_back();
      for (const Point2d& point : ring) {
        const Pose2d turned = compose({0.0, 0.0, turn}, {point.x(), point.y(), 0.0});
        field.rings.back().emplace_back(toMillimetres(turned.x), toMillimetres(turned.y));
      }
    }
    const BoundingBox extent = Polygon(rings[0], name).box();
    const bool is_small = (extent.max - extent.min).maxCoeff() < kSweeperUpTo;
    field.vehicle = is_small ? sweeper() : tractor();
    field.swath_width = is_small ? kSweeperSwath : kTractorSwath;
    placeStart(&field);
    fields_.push_back(field);
  }

  void placeStart(CoverageCase* field) {
    const CoverageArea area = field->area();
    Region::Parts parts;
    parts.drivable = area.outer;
    parts.non_drivable = area.holes;
    const BoundingBox extent = area.outer.box();
    const CollisionChecker checker(field->vehicle, kStartClearance, Region(parts));
    Pose2d pose;
    do {
      pose = {toMillimetres(uniform(extent.min.x(), extent.max.x())),
              toMillimetres(uniform(extent.min.y(), extent.max.y())), toMillimetres(uniform(-M_PI, M_PI))};
    } while (!checker.isFree(pose));
    field->start = pose;
  }

  std::mt19937 engine_;
  std::vector<CoverageCase> fields_;
};

}  // namespace

std::vector<CoverageCase> makeFields(unsigned seed, int random) { return FieldMaker(seed).make(random); }

}  // namespace benchmark
}  // namespace external_command
