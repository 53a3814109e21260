// SPDX-License-Identifier: Apache-2.0
#include "path_files.h"

#include "drawing.h"
#include "files.h"

namespace external_command {
namespace benchmark {

namespace {

constexpr double kFrame = 3.0;  ///< around path and footprints [m]
constexpr double kPixelsPerMetre = 30.0;
constexpr double kFootprintEvery = 0.8;  ///< [m]

std::string styleOf(const ReferencePoint& point) {
  const char* colour = point.direction == Direction::kForward ? "#1f5fd0" : "#d02020";
  return std::string("stroke-width=\"0.08\" stroke=\"") + colour + "\"";
}

}  // namespace

void writeCase(const ParkingCase& task, const std::string& file) {
  std::ofstream out = openForWriting(file);
  out.precision(17);
  const Point2d& origin = task.origin;
  const auto pose = [&](const char* name, const Pose2d& value) {
    out << "\"" << name << "\": [" << value.x + origin.x() << ", " << value.y + origin.y() << ", " << value.heading
        << "],\n";
  };
  const VehicleParams& vehicle = task.vehicle;
  out << "{\"name\": \"" << task.name << "\",\n\"vehicle\": {\"wheelbase\": " << vehicle.wheelbase
      << ", \"width\": " << vehicle.width << ", \"front_overhang\": " << vehicle.front_overhang
      << ", \"rear_overhang\": " << vehicle.rear_overhang << ", \"min_turning_radius\": " << vehicle.min_turning_radius
      << "},\n";
  pose("start", task.start);
  pose("goal", task.goal);
  const BoundingBox& bounds = *task.region.axleBounds();
  out << "\"bounds\": [" << bounds.min.x() + origin.x() << ", " << bounds.min.y() + origin.y() << ", "
      << bounds.max.x() + origin.x() << ", " << bounds.max.y() + origin.y() << "],\n\"obstacles\": [";
  const char* next_polygon = "";
  for (const Polygon& obstacle : task.region.nonDrivable()) {
    out << next_polygon << "[";
    const char* next_point = "";
    for (const Point2d& point : obstacle.points()) {
      out << next_point << "[" << point.x() + origin.x() << ", " << point.y() + origin.y() << "]";
      next_point = ", ";
    }
    out << "]";
    next_polygon = ",\n";
  }
  out << "]}\n";
}

void writePath(const ParkingCase& task, const Path& path, const std::string& file) {
  std::ofstream out = openForWriting(file);
  out.precision(17);
  const char* separator = "[";
  for (const ReferencePoint& point : path) {
    out << separator << "[" << point.x + task.origin.x() << ", " << point.y + task.origin.y() << ", " << point.heading
        << ", " << static_cast<int>(point.direction) << "]";
    separator = ",\n";
  }
  out << "]\n";
}

void writeDrawing(const ParkingCase& task, const Path& path, const std::string& file) {
  Point2d low = task.start.position(), high = low;
  for (const ReferencePoint& point : path) {
    for (const Point2d& corner : footprintAt(task.vehicle, point.pose(), kFrame)) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  Drawing drawing(file, low, high, kPixelsPerMetre);
  for (const Polygon& obstacle : task.region.nonDrivable()) drawing.polygon(obstacle.points(), "fill=\"#b0b0b0\"");
  double next = 0.0;
  for (const ReferencePoint& point : path) {
    if (point.s < next) continue;
    next = point.s + kFootprintEvery;
    drawing.polygon(footprintAt(task.vehicle, point.pose(), 0.0),
                    "fill=\"none\" stroke=\"#909090\" stroke-width=\"0.02\"");
  }
  drawing.polygon(footprintAt(task.vehicle, task.start, 0.0), "fill=\"none\" stroke=\"#20a020\" stroke-width=\"0.06\"");
  drawing.polygon(footprintAt(task.vehicle, task.goal, 0.0), "fill=\"none\" stroke=\"#f09000\" stroke-width=\"0.06\"");
  drawing.path(path, styleOf);
}

}  // namespace benchmark
}  // namespace external_command
