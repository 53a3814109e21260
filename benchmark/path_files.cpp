// SPDX-License-Identifier: Apache-2.0
#include "path_files.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace external_command {
namespace benchmark {

namespace {

constexpr double kFrame = 3.0;  ///< around path and footprints [m]
constexpr double kPixelsPerMetre = 30.0;
constexpr double kFootprintEvery = 0.8;  ///< [m]

std::ofstream openFile(const std::string& file) {
  std::ofstream out(file);
  if (!out) throw std::runtime_error("cannot write " + file);
  return out;
}

/// Writes SVG elements in metres; y points up.
class Drawing {
 public:
  Drawing(const std::string& file, const Point2d& low, const Point2d& high) : out_(openFile(file)) {
    const Point2d size = high - low;
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << size.x() * kPixelsPerMetre << "\" height=\""
         << size.y() * kPixelsPerMetre << "\" viewBox=\"" << low.x() << " " << -high.y() << " " << size.x() << " "
         << size.y() << "\">\n<rect x=\"" << low.x() << "\" y=\"" << -high.y()
         << "\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  }
  ~Drawing() { out_ << "</svg>\n"; }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  template <class Points>
  void polygon(const Points& points, const std::string& style) {
    shape("polygon", points, style);
  }

  template <class Points>
  void line(const Points& points, const std::string& style) {
    shape("polyline", points, "fill=\"none\" " + style);
  }

 private:
  template <class Points>
  void shape(const char* element, const Points& points, const std::string& style) {
    out_ << "<" << element << " " << style << " points=\"";
    for (const Point2d& point : points) out_ << point.x() << "," << -point.y() << " ";
    out_ << "\"/>\n";
  }

  std::ofstream out_;
};

void drawPath(const Path& path, Drawing* drawing) {
  std::vector<Point2d> leg;
  for (std::size_t i = 0; i < path.size(); ++i) {
    leg.push_back(path[i].pose().position());
    const bool ends = i > 0 && (i + 1 == path.size() || path[i + 1].direction != path[i].direction);
    if (!ends) continue;
    const char* colour = path[i].direction == Direction::kForward ? "#1f5fd0" : "#d02020";
    drawing->line(leg, std::string("stroke-width=\"0.08\" stroke=\"") + colour + "\"");
    leg = {leg.back()};
  }
}

}  // namespace

void writePath(const ParkingCase& task, const Path& path, const std::string& file) {
  std::ofstream out = openFile(file);
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
  Drawing drawing(file, low, high);
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
  drawPath(path, &drawing);
}

}  // namespace benchmark
}  // namespace external_command
