// SPDX-License-Identifier: Apache-2.0
#include "coverage_files.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <vector>

#include "coverage_check.h"
#include "drawing.h"
#include "files.h"

namespace external_command {
namespace benchmark {

namespace {

constexpr int kDecimals = 8;
constexpr double kFrame = 0.02;     ///< around the field, of its size
constexpr double kPixels = 1600.0;  ///< of the longer side

using Strips = std::vector<std::array<Point2d, 4>>;

/// Each stretch of strips that join, as one outline: between shapes of their own, hair lines would show.
std::vector<std::vector<Point2d>> outlinesOf(const Strips& strips) {
  std::vector<std::vector<Point2d>> outlines;
  for (std::size_t i = 0; i < strips.size();) {
    std::vector<Point2d> left{strips[i][0]}, right{strips[i][3]};
    do {
      left.push_back(strips[i][1]);
      right.push_back(strips[i][2]);
      ++i;
    } while (i < strips.size() && (strips[i][0] - left.back()).norm() + (strips[i][3] - right.back()).norm() < 1e-3);
    left.insert(left.end(), right.rbegin(), right.rend());
    outlines.push_back(std::move(left));
  }
  return outlines;
}

}  // namespace

void writeCoveragePath(const Path& path, const std::string& file) {
  std::ofstream out = openForWriting(file);
  out << std::fixed << std::setprecision(kDecimals);
  const char* separator = "[";
  for (const ReferencePoint& point : path) {
    out << separator << "[" << point.x << ", " << point.y << ", " << point.heading << ", "
        << static_cast<int>(point.direction) << ", " << (point.tool_on ? 1 : 0) << "]";
    separator = ",\n";
  }
  out << "]\n";
}

void drawCoverage(const CoverageCase& field, const Path& path, const std::string& file) {
  const CoverageArea area = field.area();
  const Point2d origin = area.outer.box().min;  // SVG has too few digits for coordinates far from 0
  const auto here = [&](auto points) {
    for (Point2d& point : points) point -= origin;
    return points;
  };
  const Point2d size = area.outer.box().max - origin;
  const double side = size.maxCoeff();
  const Point2d low = Point2d::Constant(-kFrame * side), high = size - low;
  Drawing drawing(file, low, high, kPixels / side);

  drawing.polygon(here(area.outer.points()), R"(fill="#e02020")");
  for (const auto& outline : outlinesOf(sweptStrips(path, field.swath_width))) {
    drawing.polygon(here(outline), R"(fill="#d5efd0")");
  }
  for (const Polygon& hole : area.holes) drawing.polygon(here(hole.points()), R"(fill="#909090")");
  drawing.outside(low, high, here(area.outer.points()));

  const double stroke = std::max(field.swath_width / 25.0, side / 6000.0);
  Path moved = path;
  for (ReferencePoint& point : moved) {
    point.x -= origin.x();
    point.y -= origin.y();
  }
  drawing.path(moved, [&](const ReferencePoint& point) {
    const char* colour = point.direction == Direction::kForward ? "#1f5fd0" : "#f09000";
    return "stroke-width=\"" + std::to_string(point.tool_on ? stroke : stroke / 2.5) + "\" stroke=\"" + colour + "\"";
  });
  const Pose2d start = field.start.value_or(path.front().pose());
  drawing.polygon(here(footprintAt(field.vehicle, start, 0.0)),
                  "fill=\"none\" stroke=\"black\" stroke-width=\"" + std::to_string(stroke) + "\"");
}

}  // namespace benchmark
}  // namespace external_command
