// SPDX-License-Identifier: Apache-2.0
#include "external_command/motion/reeds_shepp.h"

#include <algorithm>
#include <cmath>

#include "steering_words.h"

namespace external_command {

namespace {

using MakeWords = void (*)(const Pose2d&, const Pose2d&, const WordQuery&, WordSet*);

std::vector<ArcSegment> shortest(MakeWords make, const Pose2d& from, const Pose2d& to, double radius) {
  WordSet words;
  WordQuery query;
  query.radius = radius;
  make(from, to, query, &words);
  const SteeringWord word = words.takeCheapest();
  return {word.arcs.begin(), word.arcs.begin() + word.size};
}

std::vector<SteeringCurve> allCurves(MakeWords make, const Pose2d& from, const Pose2d& to, double radius,
                                     double gear_change_cost) {
  WordSet words;
  WordQuery query;
  query.radius = radius;
  query.cost.gear_change_cost = gear_change_cost;
  make(from, to, query, &words);
  std::vector<SteeringCurve> curves;
  while (words.size() > 0) {
    const SteeringWord word = words.takeCheapest();
    curves.push_back({{word.arcs.begin(), word.arcs.begin() + word.size},
                      word.length,
                      static_cast<unsigned>(word.gear_changes),
                      word.cost});
  }
  return curves;
}

}  // namespace

std::vector<ArcSegment> shortestReedsShepp(const Pose2d& from, const Pose2d& to, double radius) {
  return shortest(reedsSheppWords, from, to, radius);
}

double reedsSheppLength(const Pose2d& from, const Pose2d& to, double radius) {
  WordSet words;
  WordQuery query;
  query.radius = radius;
  reedsSheppWords(from, to, query, &words);
  return words.takeCheapest().length;
}

std::vector<SteeringCurve> reedsSheppCurves(const Pose2d& from, const Pose2d& to, double radius,
                                            double gear_change_cost) {
  return allCurves(reedsSheppWords, from, to, radius, gear_change_cost);
}

std::vector<ArcSegment> shortestDubins(const Pose2d& from, const Pose2d& to, double radius) {
  return shortest(dubinsWords, from, to, radius);
}

std::vector<SteeringCurve> dubinsCurves(const Pose2d& from, const Pose2d& to, double radius) {
  return allCurves(dubinsWords, from, to, radius, 0.0);
}

Pose2d advance(const Pose2d& from, const ArcSegment& arc, double driven) {
  const double length = std::copysign(driven, arc.length);
  const double half_turn = 0.5 * arc.kappa * length;
  // chord of the arc; its direction is that of the heading in the middle
  const double chord = std::abs(half_turn) < 1e-9 ? length : length * std::sin(half_turn) / half_turn;
  const double middle = from.heading + half_turn;
  return {from.x + chord * std::cos(middle), from.y + chord * std::sin(middle),
          normalizeAngle(from.heading + 2.0 * half_turn)};
}

Pose2d advance(const Pose2d& from, const ArcSegment& arc) { return advance(from, arc, std::abs(arc.length)); }

Pose2d endOf(const Pose2d& from, const std::vector<ArcSegment>& arcs) {
  Pose2d pose = from;
  for (const ArcSegment& arc : arcs) pose = advance(pose, arc);
  return pose;
}

Path sampleArcs(const Pose2d& from, const std::vector<ArcSegment>& arcs, double spacing) {
  const auto pointAt = [](const Pose2d& pose, const ArcSegment& arc, double s) {
    ReferencePoint point;
    point.x = pose.x, point.y = pose.y, point.heading = pose.heading;
    point.kappa = arc.kappa;
    point.s = s;
    point.direction = arc.length < 0.0 ? Direction::kReverse : Direction::kForward;
    return point;
  };
  Path path{pointAt(from, arcs.empty() ? ArcSegment{} : arcs.front(), 0.0)};
  Pose2d begin = from;
  for (const ArcSegment& arc : arcs) {
    const double length = std::abs(arc.length);
    if (length < kEmptyArc) continue;
    if (path.size() == 1) path[0] = pointAt(from, arc, 0.0);
    const double s = path.back().s;
    const auto steps = std::max(1L, std::lround(std::ceil(length / spacing - 1e-9)));
    for (long i = 1; i <= steps; ++i) {
      const double driven = length * static_cast<double>(i) / static_cast<double>(steps);
      path.push_back(pointAt(advance(begin, arc, driven), arc, s + driven));
    }
    begin = path.back().pose();
  }
  return path;
}

}  // namespace external_command
