// SPDX-License-Identifier: Apache-2.0
#include "map_drawing.h"

#include <algorithm>
#include <fstream>

#include "external_command/core/error.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kFrame = 0.03;              // around the map, of its longer side
constexpr double kPixels = 1600.0;           // of the longer side
constexpr double kMark = 0.004;              // radius, of the longer side
constexpr double kLeastMark = 1.0;           // radius [m]
constexpr double kFinest = 1.0 / 4000.0;     // between points of a line, of the longer side
constexpr double kShowsCentres = 4000.0;     // side of a map on which centre lines can be told from lanes [m]
constexpr std::size_t kLongestMark = 10000;  // text of a mark [bytes]

const char* colourOf(FaultSeverity severity) { return severity == FaultSeverity::kError ? "#d01010" : "#f09000"; }

/// A text as XML has it.
std::string escaped(const std::string& words) {
  std::string xml;
  for (const char c : printable(words, kLongestMark)) {
    switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      default:
        xml += c;
    }
  }
  return xml;
}

/// In metres from the lower left corner of the map: SVG has too few digits for coordinates far from 0. y points up.
class Drawing {
 public:
  Drawing(const BoundingBox& box, std::ofstream* out) : origin_(box.min), out_(*out) {
    const Point2d size = box.max - box.min;
    side_ = std::max(1.0, size.maxCoeff());
    const double frame = kFrame * side_, scale = kPixels / side_;
    const Point2d whole = size + Point2d::Constant(2.0 * frame);
    out_.precision(7);
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << whole.x() * scale << "\" height=\""
         << whole.y() * scale << "\" viewBox=\"" << -frame << " " << -size.y() - frame << " " << whole.x() << " "
         << whole.y() << "\">\n<rect x=\"" << -frame << "\" y=\"" << -size.y() - frame
         << "\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  }

  double side() const { return side_; }

  void polygon(const Polygon& shape, const char* style) {
    out_ << "<polygon " << style << " points=\"";
    write(shape.points());
    out_ << "\"/>\n";
  }

  void lane(const Lane& lane) {
    const double width = lane.widthAt(lane.length() / 2.0);
    const char* colour = lane.isDrivable() ? "#c8ccd4" : "#eceadf";
    line(lane, colour, std::clamp(width, 0.5, 10.0));
  }

  void centre(const Lane& lane) {
    if (lane.isDrivable() && side_ < kShowsCentres) line(lane, "#8090a8", std::max(0.15, side_ / 6000.0));
  }

  void mark(const MapFinding& finding) {
    if (!finding.place) return;
    const Point2d at = *finding.place - origin_;
    const double radius = std::max(kLeastMark, kMark * side_);
    out_ << "<circle cx=\"" << at.x() << "\" cy=\"" << -at.y() << "\" r=\"" << radius << "\" fill=\""
         << colourOf(finding.severity) << "\" fill-opacity=\"0.45\" stroke=\"" << colourOf(finding.severity)
         << "\" stroke-width=\"" << radius / 5.0 << "\"><title>" << kindOf(finding.fault).name << ": "
         << escaped(finding.what) << "</title></circle>\n";
  }

  void end() { out_ << "</svg>\n"; }

 private:
  /// Without points that nobody could tell apart.
  void line(const Lane& lane, const char* colour, double width) {
    std::vector<Point2d> shown{lane.center.points().front()};
    for (const Point2d& point : lane.center.points()) {
      if ((point - shown.back()).norm() > kFinest * side_) shown.push_back(point);
    }
    shown.push_back(lane.center.points().back());
    out_ << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"" << width << "\" points=\"";
    write(shown);
    out_ << "\"/>\n";
  }

  void write(const std::vector<Point2d>& points) {
    for (const Point2d& point : points) out_ << point.x() - origin_.x() << "," << origin_.y() - point.y() << " ";
  }

  Point2d origin_;
  double side_;
  std::ofstream& out_;
};

}  // namespace

void drawMap(const MapReport& report, const std::string& file) {
  const HdMap& map = *report.map;
  std::ofstream out(file);
  Drawing drawing(map.box(), &out);
  for (const Area& area : map.areas()) drawing.polygon(area.polygon, "fill=\"#dcebf7\"");
  for (const Junction& junction : map.junctions()) drawing.polygon(junction.polygon, "fill=\"#f4f0f8\"");
  for (const Lane& lane : map.lanes()) drawing.lane(lane);
  for (const Lane& lane : map.lanes()) drawing.centre(lane);
  for (const ParkingSpace& space : map.parkingSpaces()) {
    drawing.polygon(space.polygon, "fill=\"#d9f0d4\" stroke=\"#60a060\" stroke-width=\"0.1\"");
  }
  // Errors lie on top.
  for (auto finding = report.findings.rbegin(); finding != report.findings.rend(); ++finding) drawing.mark(*finding);
  drawing.end();
  out.flush();
  if (!out) throw MapError(text("the drawing ", file, " cannot be written"));
}

}  // namespace external_command
