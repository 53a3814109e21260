// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_progress.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "coverage/field/geometry.h"
#include "coverage/field/grid.h"
#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr int kMostLaps = 10000;
constexpr double kRounding = 1e-6;    ///< of lengths that were written and read [m]
constexpr double kBendSlack = 1.001;  ///< curvatures come from searches that round
constexpr double kMostCells = 4e6;    ///< of the raster that tells what lies in the area
constexpr double kCell = 0.25;        ///< of it, where the area is not too large for that [m]
constexpr double kMostColumns = 1e5;  ///< of it
constexpr double kMostSwept = 4.0;    ///< metres in all, as multiple of a path that sweeps everything once
constexpr double kMostAcross = 30.0;  ///< the same for small areas, as multiple of their diagonal
constexpr double kLongest = 1e7;      ///< [m]

Point2d sizeOf(const BoundingBox& box) { return box.max - box.min; }

/// Looks at one line after the other; `who` in the texts is "swath 7".
class LineCheck {
 public:
  LineCheck(const Polygon& area, const VehicleParams& vehicle, const CoverageParams& params, const CancelToken& cancel)
      : vehicle_(vehicle),
        cancel_(cancel),
        origin_(area.box().min),
        size_(sizeOf(area.box())),
        cell_(std::max({kCell, std::sqrt(size_.x() * size_.y() / kMostCells), size_.maxCoeff() / kMostColumns})),
        inside_({Point2d::Zero(), size_}, cell_),
        rest_(std::min(kLongest, kMostSwept * area.area() / params.swath_width + kMostAcross * size_.norm())) {
    std::vector<Point2d> points = area.points();
    for (Point2d& point : points) point -= origin_;
    inside_.set(only(shapeOf(points)), kFree);
  }

  void check(const SwathLine& line, const std::string& who) {
    if (line.lap < -1 || line.lap > kMostLaps) throw InvalidRequest(text(who, " is said to be lap ", line.lap));
    if (line.arcs.empty()) throw InvalidRequest(text(who, " has no length"));
    if (!std::isfinite(line.start.heading)) throw InvalidRequest(text(who, " begins with no heading"));
    Pose2d pose = line.start;
    requireInside(pose, who);
    for (const ArcSegment& arc : line.arcs) {
      cancel_.throwIfCancelled();
      const double most = 1.0 / vehicle_.min_turning_radius * kBendSlack;
      if (!(std::abs(arc.kappa) <= most)) {
        throw InvalidRequest(text(who, " bends by ", arc.kappa, " 1/m, the vehicle by ", most, " at most"));
      }
      const double longest = std::min(2.0 * M_PI / std::abs(arc.kappa), M_PI * size_.norm());  // that stays in the area
      if (!(std::abs(arc.length) <= kBendSlack * longest)) {
        throw InvalidRequest(
            text(who, " has an arc of ", arc.length, " m, longer than the ", longest, " m that fit into such an area"));
      }
      rest_ -= std::abs(arc.length);
      if (!(rest_ >= 0.0)) throw InvalidRequest(text(who, " makes the swaths longer than such an area needs"));
      pose = advance(pose, arc);
      requireInside(pose, who);
    }
  }

 private:
  /// Within a cell of it: the raster is as coarse as that.
  void requireInside(const Pose2d& pose, const std::string& who) const {
    const Point2d p = pose.position() - origin_;
    const bool near = (p.array() >= -cell_).all() && (p.array() <= (size_ + Point2d(cell_, cell_)).array()).all();
    for (const double dx : {0.0, -cell_, cell_}) {
      for (const double dy : {0.0, -cell_, cell_}) {
        if (near && (inside_.at(Point2d(p.x() + dx, p.y() + dy)) & kFree) != 0) return;
      }
    }
    throw InvalidRequest(text(who, " leaves the area at ", at(pose.position())));
  }

  const VehicleParams& vehicle_;
  const CancelToken& cancel_;
  Point2d origin_;
  Point2d size_;
  double cell_;
  CoverageGrid inside_;
  double rest_;  ///< of the length of all lines [m]
};

void requireProgress(const CoverageProgress& progress) {
  const std::size_t total = progress.lines.size();
  if (progress.swept.size() > total) {
    throw InvalidRequest(text("progress of ", progress.swept.size(), " swaths, but the plan has ", total));
  }
  for (std::size_t i = 0; i < progress.swept.size(); ++i) {
    const double length = progress.lines[i].length();
    if (progress.swept[i] >= 0.0 && progress.swept[i] <= length + kRounding) continue;
    throw InvalidRequest(text("swath ", i, " is ", metres(length), " long, but swept for ", progress.swept[i], " m"));
  }
  std::vector<bool> seen(total, false);
  for (const std::size_t index : progress.skipped) {
    if (index >= total) {
      throw InvalidRequest(
          text("skipped swath ", index, " is not in the plan; its swaths are 0 to ", total > 0 ? total - 1 : 0));
    }
    if (seen[index]) throw InvalidRequest(text("swath ", index, " is skipped twice"));
    seen[index] = true;
  }
}

}  // namespace

double SwathLine::length() const {
  double sum = 0.0;
  for (const ArcSegment& arc : arcs) sum += std::abs(arc.length);
  return sum;
}

bool CoverageProgress::isDone(std::size_t line) const {
  const double done = sweptOf(line);
  return done > 0.0 && done >= lines[line].length() - kLineEnd;
}

bool CoverageProgress::isSkipped(std::size_t line) const {
  return std::find(skipped.begin(), skipped.end(), line) != skipped.end();
}

std::size_t CoverageProgress::countDone() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) count += isDone(i);
  return count;
}

bool CoverageProgress::sweep(std::size_t line, double length) {
  if (length <= sweptOf(line)) return false;
  if (swept.size() < lines.size()) swept.resize(lines.size(), 0.0);
  swept[line] = std::min(length, lines[line].length());
  if (isDone(line)) skipped.erase(std::remove(skipped.begin(), skipped.end(), line), skipped.end());
  return true;
}

void CoverageProgress::merge(const CoverageProgress& other) {
  const std::size_t common = std::min(lines.size(), other.lines.size());
  for (std::size_t i = 0; i < common; ++i) sweep(i, other.sweptOf(i));
}

void requirePlausible(const CoverageProgress& progress, const Polygon& area, const VehicleParams& vehicle,
                      const CoverageParams& params, const CancelToken& cancel) {
  std::size_t arcs = 0;
  for (const SwathLine& line : progress.lines) arcs += line.arcs.size();
  if (progress.lines.size() > CoverageProgress::kMostLines || arcs > CoverageProgress::kMostArcs) {
    throw InvalidRequest(text("a plan of ", progress.lines.size(), " swaths with ", arcs, " arcs; at most ",
                              CoverageProgress::kMostLines, " and ", CoverageProgress::kMostArcs, " are taken"));
  }
  if (!progress.lines.empty()) {
    LineCheck check(area, vehicle, params, cancel);
    for (std::size_t i = 0; i < progress.lines.size(); ++i) check.check(progress.lines[i], text("swath ", i));
  }
  requireProgress(progress);
}

}  // namespace external_command
