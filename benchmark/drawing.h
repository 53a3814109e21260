// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "external_command/core/path.h"
#include "files.h"

namespace external_command {
namespace benchmark {

/// Writes SVG elements in metres; y points up.
class Drawing {
 public:
  Drawing(const std::string& file, const Point2d& low, const Point2d& high, double pixels_per_metre)
      : out_(openForWriting(file)) {
    const Point2d size = high - low;
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << size.x() * pixels_per_metre << "\" height=\""
         << size.y() * pixels_per_metre << "\" viewBox=\"" << low.x() << " " << -high.y() << " " << size.x() << " "
         << size.y() << "\">\n<rect x=\"" << low.x() << "\" y=\"" << -high.y()
         << "\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  }
  ~Drawing() { out_ << "</svg>\n"; }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  template <class Points>
  void polygon(const Points& points, const std::string& style) {
    out_ << "<polygon " << style << " points=\"";
    write(points);
    out_ << "\"/>\n";
  }

  template <class Points>
  void line(const Points& points, const std::string& style) {
    out_ << "<polyline fill=\"none\" " << style << " points=\"";
    write(points);
    out_ << "\"/>\n";
  }

  /// Paints what lies between the polygon and the box around it white.
  template <class Points>
  void outside(const Point2d& low, const Point2d& high, const Points& points) {
    out_ << "<path fill=\"white\" fill-rule=\"evenodd\" stroke=\"#404040\" stroke-width=\"0.1\" d=\"M";
    write(std::vector<Point2d>{low, {high.x(), low.y()}, high, {low.x(), high.y()}});
    out_ << "ZM";
    write(points);
    out_ << "Z\"/>\n";
  }

  /// The path, as one line for each stretch of points that have the same style.
  template <class StyleOf>
  void path(const Path& points, const StyleOf& style_of) {
    std::vector<Point2d> stretch;
    for (std::size_t i = 0; i < points.size(); ++i) {
      stretch.push_back(points[i].pose().position());
      if (i == 0 || (i + 1 < points.size() && style_of(points[i + 1]) == style_of(points[i]))) continue;
      line(stretch, style_of(points[i]));
      stretch = {stretch.back()};
    }
  }

 private:
  template <class Points>
  void write(const Points& points) {
    for (const Point2d& point : points) out_ << point.x() << "," << -point.y() << " ";
  }

  std::ofstream out_;
};

}  // namespace benchmark
}  // namespace external_command
