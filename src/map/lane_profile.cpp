// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "external_command/map/hd_map.h"

namespace external_command {

namespace {

constexpr double kDefaultWidth = 3.5;  // [m], of a whole lane

double interpolated(const std::vector<WidthSample>& samples, double s) {
  const auto after = std::upper_bound(samples.begin(), samples.end(), s,
                                      [](double value, const WidthSample& sample) { return value < sample.s; });
  if (after == samples.begin()) return after->width;
  const WidthSample& before = *(after - 1);
  if (after == samples.end()) return before.width;
  return before.width + (after->width - before.width) * (s - before.s) / (after->s - before.s);
}

double distanceTo(const std::vector<Point2d>& line, const Point2d& point) {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    squared = std::min(squared, (point - nearestOnSegment(point, line[i], line[i + 1])).squaredNorm());
  }
  return std::sqrt(squared);
}

double halfWidth(const std::vector<WidthSample>& samples, const LaneBoundary& boundary, const Polyline& center,
                 double s) {
  if (!samples.empty()) return interpolated(samples, s);
  if (boundary.points.size() >= 2) return distanceTo(boundary.points, center.pointAt(s));
  return kDefaultWidth / 2.0;
}

}  // namespace

std::optional<double> Lane::heightAt(double s) const {
  if (heights.empty()) return std::nullopt;
  const auto after = std::upper_bound(heights.begin(), heights.end(), s,
                                      [](double value, const HeightSample& sample) { return value < sample.s; });
  if (after == heights.begin()) return after->z;
  const HeightSample& before = *(after - 1);
  if (after == heights.end() || after->s <= before.s) return before.z;
  return before.z + (after->z - before.z) * (s - before.s) / (after->s - before.s);
}

double Lane::leftWidthAt(double s) const { return halfWidth(left_widths, left, center, s); }

double Lane::rightWidthAt(double s) const { return halfWidth(right_widths, right, center, s); }

}  // namespace external_command
