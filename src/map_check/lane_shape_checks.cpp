// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "checks.h"

namespace external_command {

namespace {

constexpr int kParts = 8;               // of a lane, at whose ends its width is looked at
constexpr double kWidest = 10.0;        // of a lane [m]
constexpr double kWidthError = 0.5;     // between samples and boundary [m]
constexpr double kClearlyBeside = 0.2;  // of a boundary, on the wrong side [m]
constexpr double kSlowest = 1.0;        // of plausible speed limits [m/s]
constexpr double kFastest = 42.0;       // just over 150 km/h [m/s]
constexpr double kSharpestBend = 2.0;   // of the vehicle's curvature
constexpr double kBendLength = 3.0;     // over which a bend is measured [m]

/// nullopt where there are no two points to make one of.
std::optional<Polyline> lineOf(const LaneBoundary& boundary) {
  const std::vector<Point2d>& points = boundary.points;
  const auto differs = [&](const Point2d& point) { return (point - points.front()).norm() > 0.002; };
  if (std::none_of(points.begin(), points.end(), differs)) return std::nullopt;
  return Polyline(points);
}

class LaneShape {
 public:
  LaneShape(const MapUnderCheck& check, const Lane& lane) : check_(check), lane_(lane) {}

  void run() {
    if (lane_.direction == LaneDirection::kBackward) add(MapFault::kDirectionBackward, 0.0, lane_.id);
    checkSpeedLimit();
    checkWidths();
    checkBends();
    checkBoundary(lane_.left, lane_.left_widths, true);
    checkBoundary(lane_.right, lane_.right_widths, false);
  }

 private:
  template <class... Args>
  void add(MapFault fault, double s, const Args&... what) {
    check_.faults->add(fault, {lane_.id}, {lane_.center.pointAt(s)}, what...);
  }

  template <class... Args>
  void addSized(MapFault fault, double s, double size, const Args&... what) {
    check_.faults->add(fault, {lane_.id}, {lane_.center.pointAt(s), size}, what...);
  }

  void checkSpeedLimit() {
    const double limit = lane_.speed_limit;
    if (limit == 0.0) return add(MapFault::kSpeedLimitMissing, 0.0, lane_.id);
    if (limit >= kSlowest && limit <= kFastest) return;
    addSized(MapFault::kSpeedLimitAbsurd, 0.0, limit, lane_.id, ": ", limit, " m/s, which is ", 3.6 * limit, " km/h");
  }

  void checkWidths() {
    double narrowest = std::numeric_limits<double>::infinity(), widest = 0.0, narrow_s = 0.0, wide_s = 0.0;
    for (int part = 0; part <= kParts; ++part) {
      const double s = lane_.length() * part / kParts, width = lane_.widthAt(s);
      if (width < narrowest) narrowest = width, narrow_s = s;
      if (width > widest) widest = width, wide_s = s;
    }
    const double vehicle = check_.vehicle.width;
    if (narrowest < vehicle) {
      addSized(MapFault::kLaneNarrow, narrow_s, vehicle - narrowest, lane_.id, " at s ", metres(narrow_s), ", ",
               metres(narrowest), " wide; the vehicle is ", metres(vehicle));
    }
    if (widest > kWidest) {
      addSized(MapFault::kLaneWide, wide_s, widest, lane_.id, " at s ", metres(wide_s), ", ", metres(widest));
    }
  }

  /// Between points as far apart as a bend is long: the corners of a coarse centre line are no bends.
  void checkBends() {
    const double limit = kSharpestBend * check_.vehicle.maxKappa();
    double worst = limit, worst_s = 0.0;
    for (double s = 0.0; s + 2.0 * kBendLength <= lane_.length(); s += kBendLength / 2.0) {
      const Point2d a = lane_.center.pointAt(s), b = lane_.center.pointAt(s + kBendLength),
                    c = lane_.center.pointAt(s + 2.0 * kBendLength);
      const double sides = (b - a).norm() * (c - b).norm() * (c - a).norm();
      const double kappa = sides > 1e-9 ? 2.0 * std::abs(cross(b - a, c - b)) / sides : 0.0;
      if (kappa > worst) worst = kappa, worst_s = s + kBendLength;
    }
    if (worst == limit) return;
    addSized(MapFault::kLaneSharpBend, worst_s, worst, lane_.id, " at s ", metres(worst_s), ", radius ",
             metres(1.0 / worst), "; the vehicle turns on ", metres(check_.vehicle.min_turning_radius));
  }

  void checkBoundary(const LaneBoundary& boundary, const std::vector<WidthSample>& samples, bool is_left) {
    const char* side = is_left ? "left" : "right";
    const auto line = lineOf(boundary);
    if (!line) {
      if (samples.empty()) add(MapFault::kWidthMissing, 0.0, lane_.id, " at its ", side);
      return;
    }
    checkSide(*line, is_left);
    const double middle = lane_.length() / 2.0;
    const Point2d ahead = unitVector(lane_.center.headingAt(middle));
    const double s = line->project(lane_.center.pointAt(middle)).s;
    if (lane_.length() > 1.0 && unitVector(line->headingAt(s)).dot(ahead) < -0.5) {
      add(MapFault::kBoundaryReversed, middle, "the ", side, " one of ", lane_.id);
    }
    if (!samples.empty()) compareWidths(*line, is_left);
  }

  /// By places along the centre line: the ends of a boundary may lie before or behind the lane.
  void checkSide(const Polyline& line, bool is_left) {
    double worst = 0.0, worst_s = 0.0;
    int wrong = 0;
    for (int part = 1; part < kParts; ++part) {
      const double s = lane_.length() * part / kParts;
      const Point2d center = lane_.center.pointAt(s);
      const Point2d beside = line.pointAt(line.project(center).s) - center;
      const double left = cross(unitVector(lane_.center.headingAt(s)), beside);
      const double off = is_left ? -left : left;
      if (off > kClearlyBeside) ++wrong;
      if (off > worst) worst = off, worst_s = s;
    }
    if (wrong == 0) return;
    addSized(MapFault::kBoundaryWrongSide, worst_s, worst, "the ", is_left ? "left" : "right", " one of ", lane_.id,
             " at s ", metres(worst_s), ", by ", metres(worst));
  }

  void compareWidths(const Polyline& line, bool is_left) {
    double worst = kWidthError, worst_s = 0.0, stated = 0.0, measured = 0.0;
    for (int part = 1; part < kParts; ++part) {
      const double s = lane_.length() * part / kParts;
      const double by_samples = is_left ? lane_.leftWidthAt(s) : lane_.rightWidthAt(s);
      const double by_line = line.project(lane_.center.pointAt(s)).distance;
      if (std::abs(by_samples - by_line) <= worst) continue;
      worst = std::abs(by_samples - by_line);
      worst_s = s;
      stated = by_samples;
      measured = by_line;
    }
    if (worst == kWidthError) return;
    addSized(MapFault::kWidthDisagrees, worst_s, worst, lane_.id, " at s ", metres(worst_s), ", ",
             is_left ? "left" : "right", ": ", metres(stated), " by the samples, ", metres(measured),
             " to the boundary");
  }

  const MapUnderCheck& check_;
  const Lane& lane_;
};

}  // namespace

void checkLaneShapes(const MapUnderCheck& check) {
  for (const Lane& lane : check.map.lanes()) {
    if (lane.isDrivable() && !lane.is_reversed) LaneShape(check, lane).run();
  }
}

}  // namespace external_command
