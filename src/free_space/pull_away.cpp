// SPDX-License-Identifier: Apache-2.0
#include "pull_away.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace external_command {

namespace {

constexpr double kGentler = 0.7;   ///< from one curvature to the next
constexpr int kGentlest = 24;      ///< number of the last one; the radius is 5,000 times that of full lock there
constexpr double kStep = 0.125;    ///< after which the next curvature is tried, of the overhang that swings out
constexpr double kFarthest = 3.0;  ///< in lengths of the vehicle

constexpr std::size_t kMostTried = 2;  ///< at each end

/// One gear, and the side to steer to: 1 left, -1 right.
struct PullAwaySide {
  int gear;
  int steer;
};

/// Grows the curvature as fast as the end that swings out allows: each arc is looked at up to where that end is
/// nearest to a straight wall, when it has been driven as far as the end lies behind the rear axle. From there on it
/// draws away, so that what has begun can go on.
std::optional<Arcs> pullAway(const Scene& scene, const Pose2d& from, const PullAwaySide& side) {
  const FootprintBox& box = scene.index.box();
  const double overhang = box.half_length - side.gear * box.centre;
  const double step = kStep * overhang, farthest = kFarthest * 2.0 * box.half_length;
  const auto arcOf = [&](int number, double length) {
    return ArcSegment{side.gear * length, side.steer * std::pow(kGentler, number) / scene.radius};
  };
  Arcs arcs;
  Pose2d pose = from;
  int number = 0;
  const auto isFree = [&](int at) { return scene.index.keepsMargin(pose, arcOf(at, overhang)); };
  while (number <= kGentlest && !isFree(number)) ++number;
  if (number > kGentlest) return std::nullopt;
  for (double driven = 0.0; number > 0; driven += step) {
    if (driven > farthest || !isFree(number)) return std::nullopt;
    arcs.push_back(arcOf(number, step));
    pose = advance(pose, arcs.back());
    while (number > 0 && isFree(number - 1)) --number;
  }
  return merged(arcs);
}

}  // namespace

std::vector<Arcs> pullAways(const Scene& scene, const Pose2d& from) {
  std::vector<Arcs> found;
  for (const int gear : {1, -1}) {
    for (const int steer : {1, -1}) {
      const std::optional<Arcs> arcs = pullAway(scene, from, {gear, steer});
      if (arcs && arcs->empty()) return {};
      if (arcs) found.push_back(*arcs);
    }
  }
  std::sort(found.begin(), found.end(), [](const Arcs& a, const Arcs& b) { return lengthOf(a) < lengthOf(b); });
  return found;
}

namespace {

/// Where the search begins or ends, and what leads there.
struct Junction {
  Arcs arcs;  ///< from the start, or backwards from the goal
  Pose2d pose;
};

std::vector<Junction> junctionsAt(const Scene& scene, const Pose2d& pose) {
  std::vector<Junction> junctions;
  for (const Arcs& arcs : pullAways(scene, pose)) {
    if (junctions.size() < kMostTried) junctions.push_back({arcs, endOf(pose, arcs)});
  }
  return junctions;
}

Query between(const Query& query, const Junction& first, const Junction& last) {
  Query inner{first.pose, last.pose, query.junctions};
  if (!first.arcs.empty()) {
    inner.junctions.before = gearOf(first.arcs.back()), inner.junctions.kappa_before = first.arcs.back().kappa;
  }
  if (!last.arcs.empty()) {
    inner.junctions.after = -gearOf(last.arcs.back()), inner.junctions.kappa_after = last.arcs.back().kappa;
  }
  return inner;
}

Arcs joined(const Junction& first, const Arcs& middle, const Junction& last) {
  Arcs arcs = first.arcs;
  arcs.insert(arcs.end(), middle.begin(), middle.end());
  const Arcs rest = reversed(last.arcs);
  arcs.insert(arcs.end(), rest.begin(), rest.end());
  return merged(arcs);
}

FirstPath findPathPullingAway(const Scene& scene, const Query& query, const BoundingBox& area,
                              const FirstPathRequest& request, const StopCondition& stop) {
  std::vector<Junction> firsts = junctionsAt(scene, query.start), lasts = junctionsAt(scene, query.goal);
  FirstPath result{TwoWaySearch::Outcome::kNone, {}, std::nullopt};
  if (firsts.empty() && lasts.empty()) return result;
  if (firsts.empty()) firsts.push_back({{}, query.start});
  if (lasts.empty()) lasts.push_back({{}, query.goal});
  for (const Junction& first : firsts) {
    for (const Junction& last : lasts) {
      FirstPath inner = findFirstPath(scene, between(query, first, last), area, request, stop);
      if (inner.outcome == TwoWaySearch::Outcome::kFound) {
        inner.arcs = joined(first, inner.arcs, last);
        return inner;
      }
      if (inner.outcome != TwoWaySearch::Outcome::kNone) result.outcome = inner.outcome;
    }
  }
  return result;
}

}  // namespace

std::vector<FirstPath> findFirstPaths(const Scene& scene, const Query& query, const BoundingBox& area,
                                      const FirstPathRequest& request, const StopCondition& stop) {
  if (scene.index.easedMargins().empty()) return {findFirstPath(scene, query, area, request, stop)};
  FirstPathRequest few = request;
  few.max_steps = std::min(request.max_steps, kFirstLookSteps);
  const FirstPath away = findPathPullingAway(scene, query, area, few, stop);
  const bool is_found = away.outcome == TwoWaySearch::Outcome::kFound;
  const FirstPath alone = findFirstPath(scene, query, area, is_found ? few : request, stop);
  if (is_found) return {alone, away};
  if (alone.outcome != TwoWaySearch::Outcome::kNone || alone.no_way) return {alone};
  if (away.outcome == TwoWaySearch::Outcome::kNone || few.max_steps == request.max_steps) return {away};
  return {findPathPullingAway(scene, query, area, request, stop)};
}

}  // namespace external_command
