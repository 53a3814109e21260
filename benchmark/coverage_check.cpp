// SPDX-License-Identifier: Apache-2.0
#include "coverage_check.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/text.h"
#include "footprint_check.h"
#include "line_sample.h"
#include "motion.h"
#include "reachable_area.h"

namespace external_command {
namespace benchmark {

namespace {

constexpr double kCornerStep = 0.1;           // [m]
constexpr double kFootprintTolerance = 0.01;  // [m]
constexpr double kStripTurn = 0.04;           ///< of one strip, at most: its sides are straight [rad]
constexpr double kLinesPerSwath = 40.0;
constexpr double kMaxLines = 20000.0;
constexpr double kStartDistance = 0.05;  // [m]
constexpr double kStartTurn = M_PI / 180.0;
constexpr double kCurvatureTolerance = 1.02;
constexpr double kTurnTolerance = 1e-3;  ///< over half a metre [rad]
constexpr double kStepTolerance = 2e-3;  ///< of one step [rad]
constexpr double kWindow = 0.5;          ///< that curvature is measured over [m]
constexpr double kStandstill = 1e-6;     // [m]

/// From one point of the path to the next.
struct Step {
  Pose2d from;
  Twist twist;
  Direction gear;
  bool works;
  std::size_t pieces;  ///< between which no corner of the footprint moves more than kCornerStep
};

std::vector<Step> stepsOf(const Path& path, const VehicleParams& vehicle) {
  const double reach =
      std::hypot(std::max(vehicle.wheelbase + vehicle.front_overhang, vehicle.rear_overhang), vehicle.width / 2.0);
  std::vector<Step> steps;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Twist twist = twistBetween(path[i - 1].pose(), path[i].pose());
    const double moved = twist.distance() + reach * std::abs(twist.turn);
    const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(moved / kCornerStep)));
    steps.push_back({path[i - 1].pose(), twist, path[i].direction, path[i].tool_on, pieces});
  }
  return steps;
}

void countTurns(const std::vector<Step>& steps, CoverageCheck* check) {
  const Step *before = nullptr, *work = nullptr;
  for (const Step& step : steps) {
    check->length += std::abs(step.twist.forward);
    if (std::abs(step.twist.forward) <= kStandstill) continue;
    if (before != nullptr && before->gear != step.gear) ++check->gear_changes;
    if (step.works && work != nullptr && work != before) ++check->turns;
    before = &step;
    if (step.works) work = &step;
  }
}

void checkStart(const CoverageCase& field, const Path& path, CoverageCheck* check) {
  if (!field.start) return;
  const double distance = (path.front().pose().position() - field.start->position()).norm();
  const double turn = std::abs(angleBetween(field.start->heading, path.front().heading));
  if (distance <= kStartDistance && turn <= kStartTurn) return;
  check->faults.push_back(text("starts ", metres(distance), " and ", turn, " rad from the start"));
}

void checkInside(const CoverageCase& field, const std::vector<Step>& steps, CoverageCheck* check) {
  const FootprintCheck footprint(field, kFootprintTolerance);
  double rest = 0.0;  // that the vehicle can move without a look
  Point2d first(0.0, 0.0);
  const auto look = [&](const Pose2d& pose, double moved) {
    rest -= moved;
    if (rest > 0.0) return;
    if (footprint.isInside(pose)) {
      rest = footprint.freeDistance(pose);
    } else if (check->outside++ == 0) {
      first = pose.position();
    }
  };
  look(steps.front().from, 0.0);
  for (const Step& step : steps) {
    const auto pieces = static_cast<double>(step.pieces);
    for (std::size_t i = 1; i <= step.pieces; ++i) {
      look(along(step.from, step.twist, static_cast<double>(i) / pieces), step.twist.distance() / pieces);
    }
  }
  if (check->outside > 0) {
    check->faults.push_back(text("outside in ", check->outside, " poses, first at ", at(first)));
  }
}

/// The largest turn over half a metre, or over the whole of a leg that is shorter.
double curvatureOf(const std::vector<double>& driven, const std::vector<double>& turned) {
  if (driven.back() < 1e-3) return std::abs(turned.back()) > kStepTolerance ? 1e9 : 0.0;
  const double window = std::min(kWindow, driven.back());
  double worst = 0.0;
  for (std::size_t i = 0, j = 0; i < driven.size(); ++i) {
    while (j < driven.size() && driven[j] < driven[i] + window - 1e-9) ++j;
    if (j == driven.size()) break;
    const double turn = std::abs(turned[j] - turned[i]) - kTurnTolerance;
    worst = std::max(worst, turn / std::max(driven[j] - driven[i], 1e-9));
  }
  return worst;
}

void checkCurvature(const std::vector<Step>& steps, double limit, CoverageCheck* check) {
  std::vector<double> driven{0.0}, turned{0.0};
  std::size_t too_sharp = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i];
    if (std::abs(step.twist.turn) > limit * std::abs(step.twist.forward) + kStepTolerance) ++too_sharp;
    for (std::size_t piece = 0; piece < step.pieces; ++piece) {
      driven.push_back(driven.back() + std::abs(step.twist.forward) / static_cast<double>(step.pieces));
      turned.push_back(turned.back() + step.twist.turn / static_cast<double>(step.pieces));
    }
    if (i + 1 < steps.size() && steps[i + 1].gear == step.gear) continue;
    check->max_curvature = std::max(check->max_curvature, curvatureOf(driven, turned));
    driven = turned = {0.0};
  }
  if (check->max_curvature > limit) {
    check->faults.push_back(text("curvature of ", check->max_curvature, " /m, the limit is ", limit, " /m"));
  }
  if (too_sharp > 0) check->faults.push_back(text("turns too much in ", too_sharp, " steps"));
}

void checkGears(const std::vector<Step>& steps, CoverageCheck* check) {
  std::size_t slips = 0, against = 0;
  for (const Step& step : steps) {
    const double forward = std::abs(step.twist.forward);
    if (std::abs(step.twist.sideways) > std::min(2e-3 + 0.02 * forward, 0.02)) ++slips;
    if (forward > 1e-4 && (step.twist.forward > 0.0) != (step.gear == Direction::kForward)) ++against;
  }
  if (slips > 0) check->faults.push_back(text("slips sideways in ", slips, " steps"));
  if (against > 0) check->faults.push_back(text("moves against its gear in ", against, " steps"));
}

void measureCoverage(const CoverageCase& field, const Path& path, CoverageCheck* check) {
  Point2d low = field.rings.at(0).at(0), high = low;
  for (const Point2d& point : field.rings[0]) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Lines lines(low, std::max(field.swath_width / kLinesPerSwath, (high - low).norm() / kMaxLines));
  LineSample border, holes, reachable, swept;
  lines.add(std::vector<Ring>{field.rings[0]}, &border);
  for (std::size_t i = 1; i < field.rings.size(); ++i) lines.add(std::vector<Ring>{field.rings[i]}, &holes);
  lines.add(reachableArea(field, field.start.value_or(path.front().pose()).position()), &reachable);
  for (const auto& strip : sweptStrips(path, field.swath_width)) {
    lines.add(std::vector<std::array<Point2d, 4>>{strip}, &swept);
  }
  const double strips = lines.area(swept);
  for (LineSample* sample : {&border, &holes, &reachable, &swept}) sample->merge();

  const LineSample free = border.without(holes);
  const LineSample goal = reachable.common(free);
  const double covered = lines.area(swept.common(free));
  check->free_area = lines.area(free);
  check->reachable_area = lines.area(goal);
  check->covered_free = covered / check->free_area;
  check->covered_reachable = goal.parts.empty() ? 1.0 : lines.area(swept.common(goal)) / check->reachable_area;
  check->overlap = swept.parts.empty() ? 0.0 : strips / lines.area(swept) - 1.0;
  check->length_ratio = covered > 0.0 ? check->length * field.swath_width / covered : 0.0;
}

/// Whether a strip from `from` to `to` is straight; `to` may be the end of several steps.
bool isStraight(const Pose2d& from, const Pose2d& to) {
  const Pose2d seen = relativeTo(from, to);
  return std::abs(seen.y) < 1e-3 && std::abs(seen.heading) < 1e-4;
}

}  // namespace

std::vector<std::array<Point2d, 4>> sweptStrips(const Path& path, double width) {
  std::vector<std::array<Point2d, 4>> strips;
  const auto add = [&](const Pose2d& from, const Pose2d& to) {
    const Point2d a = Point2d(-std::sin(from.heading), std::cos(from.heading)) * width / 2.0;
    const Point2d b = Point2d(-std::sin(to.heading), std::cos(to.heading)) * width / 2.0;
    strips.push_back({from.position() + a, to.position() + b, to.position() - b, from.position() - a});
  };
  for (std::size_t i = 0; i + 1 < path.size();) {
    const std::size_t first = i++;
    if (!path[i].tool_on) continue;
    const Pose2d from = path[first].pose();
    if (isStraight(from, path[i].pose())) {
      const auto goes_on = [&](const ReferencePoint& next) {
        return next.tool_on && next.direction == path[i].direction && isStraight(from, next.pose());
      };
      while (i + 1 < path.size() && goes_on(path[i + 1])) ++i;
      add(from, path[i].pose());
      continue;
    }
    const Twist twist = twistBetween(from, path[i].pose());
    const double pieces = std::max(1.0, std::ceil(std::abs(twist.turn) / kStripTurn));
    for (double piece = 0.0; piece < pieces; ++piece) {
      add(along(from, twist, piece / pieces), along(from, twist, (piece + 1.0) / pieces));
    }
  }
  return strips;
}

CoverageCheck checkCoverage(const CoverageCase& field, const Path& path) {
  CoverageCheck check;
  if (path.size() < 2) {
    check.faults.push_back("has no way to drive");
    return check;
  }
  const std::vector<Step> steps = stepsOf(path, field.vehicle);
  countTurns(steps, &check);
  checkStart(field, path, &check);
  checkInside(field, steps, &check);
  checkCurvature(steps, kCurvatureTolerance / field.vehicle.min_turning_radius, &check);
  checkGears(steps, &check);
  measureCoverage(field, path, &check);
  return check;
}

}  // namespace benchmark
}  // namespace external_command
