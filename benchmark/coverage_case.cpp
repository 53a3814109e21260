// SPDX-License-Identifier: Apache-2.0
#include "coverage_case.h"

#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "external_command/core/text.h"
#include "files.h"
#include "json_fields.h"

namespace external_command {
namespace benchmark {

namespace {

std::string fileName(std::string name) {
  for (char& letter : name) {
    if (letter == '/' || letter == '\\' || letter == '"' || std::iscntrl(static_cast<unsigned char>(letter)) != 0) {
      letter = '_';
    }
  }
  return name.rfind('.', 0) == 0 ? "_" + name : name;
}

/// Reads one file.
class Reader {
 public:
  Reader(const std::string& file, std::vector<std::string>* skipped)
      : stem_(std::filesystem::path(file).stem().string()), skipped_(skipped) {}

  std::vector<CoverageCase> read(const JsonTree& root) {
    const std::string type = root.get("type", "");
    if (type == "FeatureCollection") {
      std::size_t index = 0;
      for (const auto& feature : root.get_child("features")) {
        what_ = text("features[", index++, "]");
        readFeature(feature.second);
      }
    } else if (type == "Feature") {
      readFeature(root);
    } else {
      readGeometry(root, JsonTree());
    }
    return std::move(fields_);
  }

  const std::string& what() const { return what_; }

 private:
  static inline const JsonTree kNothing;  // outlives what get_child() returns a reference to

  void readFeature(const JsonTree& feature) {
    readGeometry(feature.get_child("geometry", kNothing), feature.get_child("properties", kNothing));
  }

  void readGeometry(const JsonTree& geometry, const JsonTree& properties) {
    const std::string type = geometry.get("type", "");
    if (type == "Polygon") {
      add(geometry.get_child("coordinates"), properties);
    } else if (type == "MultiPolygon") {
      for (const auto& polygon : geometry.get_child("coordinates")) add(polygon.second, properties);
    } else {
      skipped_->push_back(text(what_, ": ", type.empty() ? "without geometry" : type, ", not a Polygon; left out"));
    }
  }

  void add(const JsonTree& coordinates, const JsonTree& properties) {
    CoverageCase field;
    field.name = fileName(properties.get("name", stem_));
    field.swath_width = isGiven(properties, "swath_width") ? properties.get<double>("swath_width") : kTractorSwath;
    field.vehicle = vehicleOf(properties.get_child("vehicle", kNothing), tractor());
    if (isGiven(properties, "start")) {
      const std::vector<double> pose = numbersOf(properties.get_child("start"), 3, "start");
      field.start = Pose2d{pose[0], pose[1], pose[2]};
    }
    for (const auto& ring : coordinates) field.rings.push_back(ringOf(ring.second));
    if (field.rings.empty()) throw std::runtime_error("the polygon has no border");
    fields_.push_back(std::move(field));
  }

  static bool isGiven(const JsonTree& tree, const std::string& key) {
    return tree.count(key) > 0 && tree.get<std::string>(key) != "null";
  }

  static Ring ringOf(const JsonTree& tree) {
    Ring ring;
    for (const auto& point : tree) {
      JsonTree first_two;  // of three, where there is a height
      for (const auto& number : point.second) {
        if (first_two.size() < 2) first_two.push_back(number);
      }
      const std::vector<double> xy = numbersOf(first_two, 2, "a position");
      ring.emplace_back(xy[0], xy[1]);
    }
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    return ring;
  }

  std::string stem_;
  std::string what_ = "the file's root";
  std::vector<std::string>* skipped_;
  std::vector<CoverageCase> fields_;
};

}  // namespace

CoverageArea CoverageCase::area() const {
  CoverageArea area{Polygon(rings.at(0), name), {}};
  for (std::size_t i = 1; i < rings.size(); ++i) area.holes.emplace_back(rings[i], text(name, ", hole ", i));
  return area;
}

std::vector<CoverageCase> readCoverageCases(const std::string& file, std::vector<std::string>* skipped) {
  Reader reader(file, skipped);
  try {
    JsonTree root;
    boost::property_tree::read_json(file, root);
    return reader.read(root);
  } catch (const std::exception& error) {
    throw std::runtime_error(text(file, " is no GeoJSON of fields: ", reader.what(), ": ", error.what()));
  }
}

void writeCoverageCase(const CoverageCase& field, const std::string& file) {
  std::ofstream out = openForWriting(file);
  out.precision(12);
  const VehicleParams& vehicle = field.vehicle;
  out << R"({"type": "Feature", "properties": {"name": ")" << field.name << R"(", "swath_width": )"
      << field.swath_width;
  if (field.start) {
    out << R"(, "start": [)" << field.start->x << ", " << field.start->y << ", " << field.start->heading << "]";
  }
  out << R"(, "vehicle": {"wheelbase": )" << vehicle.wheelbase << R"(, "width": )" << vehicle.width
      << R"(, "front_overhang": )" << vehicle.front_overhang << R"(, "rear_overhang": )" << vehicle.rear_overhang
      << R"(, "min_turning_radius": )" << vehicle.min_turning_radius
      << R"(}}, "geometry": {"type": "Polygon", "coordinates": [)";
  const char* separator = "[";
  for (const Ring& ring : field.rings) {
    out << separator;
    for (const Point2d& point : ring) out << "[" << point.x() << ", " << point.y() << "], ";
    out << "[" << ring[0].x() << ", " << ring[0].y() << "]]";
    separator = ", [";
  }
  out << "]}}\n";
}

}  // namespace benchmark
}  // namespace external_command
