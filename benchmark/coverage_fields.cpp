// SPDX-License-Identifier: Apache-2.0
#include "coverage_fields.h"

// Boost's JSON parser uses its bind placeholders, and says so at every build without this.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>

#include "external_command/core/text.h"
#include "external_command/free_space/collision_checker.h"
#include "external_command/free_space/region.h"

namespace external_command {
namespace benchmark {

namespace {

namespace pt = boost::property_tree;
using Ring = std::vector<Point2d>;

VehicleParams vehicleOf(double wheelbase, double width, double front, double rear, double radius) {
  VehicleParams vehicle;
  vehicle.wheelbase = wheelbase;
  vehicle.width = width;
  vehicle.front_overhang = front;
  vehicle.rear_overhang = rear;
  vehicle.min_turning_radius = radius;
  return vehicle;
}

std::vector<double> numbersOf(const pt::ptree& list) {
  std::vector<double> numbers;
  for (const auto& entry : list) numbers.push_back(entry.second.get_value<double>());
  return numbers;
}

FieldCase fieldOf(const pt::ptree& feature, const std::string& fallback_name) {
  FieldCase field;
  field.name = feature.get("properties.name", fallback_name);
  field.swath_width = feature.get("properties.swath_width", 4.0);
  field.vehicle = vehicleOf(2.5, 2.0, 0.8, 0.9, 5.0);
  if (const auto given = feature.get_child_optional("properties.vehicle")) {
    VehicleParams& vehicle = field.vehicle;
    vehicle.wheelbase = given->get("wheelbase", vehicle.wheelbase);
    vehicle.width = given->get("width", vehicle.width);
    vehicle.front_overhang = given->get("front_overhang", vehicle.front_overhang);
    vehicle.rear_overhang = given->get("rear_overhang", vehicle.rear_overhang);
    const auto steer = given->get_optional<double>("max_steer");
    const double radius = steer ? vehicle.wheelbase / std::tan(*steer) : vehicle.min_turning_radius;
    vehicle.min_turning_radius = given->get("min_turning_radius", radius);
  }
  if (const auto start = feature.get_child_optional("properties.start")) {
    const std::vector<double> pose = numbersOf(*start);
    if (pose.size() == 3) field.start = Pose2d{pose[0], pose[1], pose[2]};
  }
  for (const auto& ring : feature.get_child("geometry.coordinates")) {
    field.rings.emplace_back();
    for (const auto& point : ring.second) {
      const std::vector<double> xy = numbersOf(point.second);
      if (xy.size() < 2) throw std::runtime_error("a coordinate has fewer than two numbers");
      field.rings.back().emplace_back(xy[0], xy[1]);
    }
  }
  return field;
}

/// Makes fields with two vehicles in turn, a sweeper and a tractor, and a random free start for each.
class FieldMaker {
 public:
  explicit FieldMaker(unsigned seed) : engine_(seed) {}

  std::vector<FieldCase> make(int random) {
    for (const double size : {30.0, 60.0, 120.0, 300.0}) {
      add(text("rect_", size), {box(0, 0, size, 0.7 * size)});
      add(text("L_", size), {{{0, 0}, {size, 0}, {size, 0.4 * size}, {0.45 * size, 0.4 * size}, {0.45 * size, size},
                              {0, size}}});
      add(text("U_", size), {{{0, 0}, {size, 0}, {size, 0.8 * size}, {0.7 * size, 0.8 * size}, {0.7 * size, 0.3 * size},
                              {0.3 * size, 0.3 * size}, {0.3 * size, 0.8 * size}, {0, 0.8 * size}}});
      add(text("ring_", size), {box(0, 0, size, size), box(0.3 * size, 0.35 * size, 0.7 * size, 0.7 * size)});
      add(text("slanted_", size), {{{0, 0}, {size, 0.2 * size}, {1.5 * size, 0.9 * size}, {0.4 * size, 0.8 * size}}});
    }
    addTriangle();
    addNeck();
    addColumns();
    addWall();
    for (int i = 0; i < random; ++i) addRandom(i);
    return std::move(fields_);
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

  static Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

  void addTriangle() { add("triangle_100", {{{0, 0}, {100, 10}, {35, 80}}}); }

  void addNeck() {
    add("neck_90", {{{0, 0}, {40, 0}, {40, 18}, {52, 18}, {52, 0}, {90, 0}, {90, 45}, {52, 45}, {52, 24}, {40, 24},
                     {40, 45}, {0, 45}}});
  }

  void addColumns() {
    std::vector<Ring> rings = {box(0, 0, 90, 60)};
    for (int i = 0; i < 5; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double x = 9.3 + 17.1 * i, y = 11.2 + 18.4 * j;
        rings.push_back(box(x - 0.4, y - 0.3, x + 0.4, y + 0.3));
      }
    }
    add("columns_90", rings);
  }

  void addWall() { add("wall_70", {box(0, 0, 70, 50), box(15, 24, 50, 24.4), box(50, 8, 50.5, 20)}); }

  /// Distances from a centre at even angles, so that the polygon is simple.
  Ring star(const Point2d& centre, double radius, int corners, double roughness) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * M_PI * (i + uniform(-0.3, 0.3)) / corners;
      ring.push_back(centre + radius * uniform(1.0 - roughness, 1.0) * unitVector(angle));
    }
    return ring;
  }

  void addRandom(int number) {
    const double sizes[] = {50.0, 100.0, 150.0, 250.0, 500.0, 1000.0};
    const double size = sizes[number % 6];
    const int corners = pick(6, 20), holes = pick(0, 6);
    std::vector<Ring> rings = {star({0, 0}, size / 2.0, corners, uniform(0.2, 0.55))};
    for (int tries = 0; tries < 100 && static_cast<int>(rings.size()) <= holes; ++tries) {
      const Point2d centre(uniform(-0.4, 0.4) * size, uniform(-0.4, 0.4) * size);
      const double radius = pick(0, 3) == 0 ? uniform(0.3, 1.0) : std::min(25.0, uniform(0.02, 0.08) * size);
      bool clear = Polygon(rings[0], "border").contains(centre) &&
                   Polygon(rings[0], "border").distanceToBorder(centre) > radius + 1.0;
      for (std::size_t i = 1; i < rings.size(); ++i) {
        clear = clear && Polygon(rings[i], "hole").distanceToBorder(centre) > radius + 1.0 &&
                !Polygon(rings[i], "hole").contains(centre);
      }
      if (clear) rings.push_back(star(centre, radius, pick(4, 10), 0.4));
    }
    add(text("random_", number, "_", size, "_", corners, "v_", rings.size() - 1, "holes"), rings);
  }

  void add(const std::string& name, const std::vector<Ring>& rings) {
    FieldCase field;
    field.name = name;
    const double turn = uniform(0.0, 2.0 * M_PI), c = std::cos(turn), s = std::sin(turn);
    const bool turned = fields_.size() % 3 == 1;
    for (Ring ring : rings) {
      for (Point2d& point : ring) {
        if (turned) point = {c * point.x() - s * point.y(), s * point.x() + c * point.y()};
      }
      field.rings.push_back(ring);
    }
    const BoundingBox extent = Polygon(field.rings[0], "border").box();
    const double size = (extent.max - extent.min).maxCoeff();
    const bool sweeper = size < 45.0 || (size < 200.0 && fields_.size() % 2 == 0);
    field.vehicle = sweeper ? vehicleOf(1.6, 1.3, 0.5, 0.5, 2.5) : vehicleOf(2.5, 2.0, 0.8, 0.9, 5.0);
    field.swath_width = sweeper ? 1.6 : 4.0;
    placeStart(extent, &field);
    fields_.push_back(field);
  }

  void placeStart(const BoundingBox& extent, FieldCase* field) {
    const CoverageArea area = field->area();
    Region::Parts parts;
    parts.drivable = area.outer;
    parts.non_drivable = area.holes;
    const CollisionChecker checker(field->vehicle, 0.1, Region(parts));
    for (int tries = 0; tries < 1000; ++tries) {
      const Pose2d pose{uniform(extent.min.x(), extent.max.x()), uniform(extent.min.y(), extent.max.y()),
                        uniform(-M_PI, M_PI)};
      if (!checker.isFree(pose)) continue;
      field->start = pose;
      return;
    }
  }

  std::mt19937 engine_;
  std::vector<FieldCase> fields_;
};

}  // namespace

CoverageArea FieldCase::area() const {
  CoverageArea area{Polygon(rings.at(0), name), {}};
  for (std::size_t i = 1; i < rings.size(); ++i) area.holes.emplace_back(rings[i], text(name, " hole ", i - 1));
  return area;
}

std::vector<FieldCase> readFields(const std::string& file) {
  pt::ptree root;
  try {
    pt::read_json(file, root);
    std::string name = file.substr(file.find_last_of('/') + 1);
    name = name.substr(0, name.find('.'));
    const auto features = root.get_child_optional("features");
    if (!features) return {fieldOf(root, name)};
    std::vector<FieldCase> fields;
    for (const auto& feature : *features) {
      if (feature.second.get("geometry.type", "") != "Polygon") continue;
      fields.push_back(fieldOf(feature.second, text(name, "_", fields.size())));
    }
    return fields;
  } catch (const pt::ptree_error& error) {
    throw std::runtime_error(text(file, ": ", error.what()));
  }
}

std::string toGeoJson(const FieldCase& field) {
  std::ostringstream out;
  out.precision(12);
  const VehicleParams& v = field.vehicle;
  out << R"({"type": "Feature", "properties": {"name": ")" << field.name << R"(", "swath_width": )" << field.swath_width;
  if (field.start) {
    out << R"(, "start": [)" << field.start->x << ", " << field.start->y << ", " << field.start->heading << "]";
  }
  out << R"(, "vehicle": {"wheelbase": )" << v.wheelbase << R"(, "width": )" << v.width << R"(, "front_overhang": )"
      << v.front_overhang << R"(, "rear_overhang": )" << v.rear_overhang << R"(, "min_turning_radius": )"
      << v.min_turning_radius << R"(}}, "geometry": {"type": "Polygon", "coordinates": [)";
  for (std::size_t i = 0; i < field.rings.size(); ++i) {
    out << (i > 0 ? ", [" : "[");
    for (const Point2d& point : field.rings[i]) out << "[" << point.x() << ", " << point.y() << "], ";
    out << "[" << field.rings[i][0].x() << ", " << field.rings[i][0].y() << "]]";
  }
  out << "]}}";
  return out.str();
}

std::vector<FieldCase> makeFields(unsigned seed, int random) { return FieldMaker(seed).make(random); }

}  // namespace benchmark
}  // namespace external_command
