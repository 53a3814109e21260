// SPDX-License-Identifier: Apache-2.0
#include "anytime_improver.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "free_space/search/search_box.h"

namespace external_command {

namespace {

/// Trials that may be fruitless: of a path before it is searched anew, in the first round of that, and more of them in
/// each further one. Shape is worth more than polish where a way is long.
struct Patience {
  std::size_t before, first_round, more;
};
constexpr Patience kShortWayPatience{2000, 1000, 500};
constexpr Patience kLongWayPatience{300, 500, 250};

constexpr std::size_t kSearchSteps = 8000;    ///< of one search
constexpr double kWorthImproving = 1.1;       ///< times the best cost: a fresh path becomes about this much cheaper
constexpr double kLongWay = 15.0;             ///< of which parts are searched anew, in turning radii
constexpr double kPart = 6.0;                 ///< such a part, in turning radii; half to one and a half times that
constexpr double kAround = 3.0;               ///< a part, in turning radii
constexpr std::size_t kParts = 8;             ///< in one round
constexpr std::size_t kPartSteps = 1500;      ///< of the search for a part
constexpr std::size_t kPartPatience = 250;    ///< that makes a fresh part comparable with the one it may replace
constexpr double kPartWorthImproving = 1.25;  ///< times the cost of that; a short path gains more than a long one

/// Where along the arcs the gear changes.
std::vector<double> cuspsOf(const Arcs& arcs) {
  std::vector<double> cusps;
  double s = 0.0;
  for (std::size_t i = 0; i + 1 < arcs.size(); ++i) {
    s += std::abs(arcs[i].length);
    if (gearOf(arcs[i]) != gearOf(arcs[i + 1])) cusps.push_back(s);
  }
  return cusps;
}

}  // namespace

AnytimeImprover::AnytimeImprover(const Scene& scene, const DrivingCost& cost, const Query& query,
                                 const BoundingBox& area, std::uint64_t seed)
    : scene_(scene),
      cost_(cost),
      query_(query),
      area_(area),
      random_(seed),
      improver_(scene, cost, query, random_.bits()) {}

Arcs AnytimeImprover::improve(const Arcs& arcs, WorkBudget* budget) {
  const auto costs = [&](const Arcs& path) { return cost_.of(query_.start, path, query_.junctions); };
  const auto isLong = [&](const Arcs& path) { return lengthOf(path) > kLongWay * scene_.radius; };
  const auto patient = [&](const Arcs& path) { return isLong(path) ? kLongWayPatience : kShortWayPatience; };
  Arcs best = improver_.improve(arcs, patient(arcs).before, budget);
  if (budget->isUsedUp() || best.empty()) return best;
  TwoWaySearch search(scene_, query_, area_);
  for (std::size_t round = 0; !budget->isUsedUp(); ++round) {
    const std::size_t patience = patient(best).first_round + round * patient(best).more;
    if (isLong(best)) {
      for (std::size_t i = 0; i < kParts && isLong(best) && !budget->isUsedUp(); ++i) {
        best = withPartSearched(best, budget);
      }
      best = improver_.improve(best, patience, budget);
      if (round % 4 != 0) continue;
    }
    const TwoWaySearch::Variant variant{round % 2, random_.uniform(1.0, 1.6), random_.uniform(0.7, 1.3),
                                        random_.uniform()};
    const TwoWaySearch::Limits limits{kSearchSteps, kWorthImproving * costs(best), [&] { return !budget->spend(); }};
    if (search.run(variant, limits) == TwoWaySearch::Outcome::kFound) {
      const Arcs other = improver_.improve(search.arcs(), patience, budget);
      if (costs(other) < costs(best)) best = other;
    }
    best = improver_.improve(best, patience, budget);
  }
  return best;
}

/// The path with a part of it replaced by a cheaper one, or as it was. What the search finds is made better before it
/// is compared: as it comes, a part with fewer cusps is mostly dearer than one that was improved all along.
Arcs AnytimeImprover::withPartSearched(const Arcs& arcs, WorkBudget* budget) {
  const Track track(query_, arcs, cost_);
  const double length = std::min(random_.uniform(0.5, 1.5) * kPart * scene_.radius, track.length());
  const double begin = beginOfPart(track, length);
  const Track::Place from = track.arriving(begin), to = track.leaving(begin + length);
  std::vector<Point2d> points{from.pose.position(), to.pose.position()};
  for (double s = begin; s < begin + length; s += scene_.radius) points.push_back(track.leaving(s).pose.position());
  const Query query{from.pose, to.pose, {from.gear, to.gear, from.kappa, to.kappa}};
  TwoWaySearch search(scene_, query, searchBox(points, kAround * scene_.radius, area_));
  const TwoWaySearch::Variant variant{0, random_.uniform(1.0, 1.6), random_.uniform(0.7, 1.3), random_.uniform()};
  const TwoWaySearch::Limits limits{kPartSteps, kPartWorthImproving * (to.cost - from.cost),
                                    [&] { return !budget->spend(); }};
  if (search.run(variant, limits) != TwoWaySearch::Outcome::kFound) return arcs;
  PathImprover improver(scene_, cost_, query, random_.bits());
  const Arcs other = track.spliced(from, improver.improve(search.arcs(), kPartPatience, budget), to);
  return cost_.of(query_.start, other, query_.junctions) < track.cost() ? other : arcs;
}

/// Where a part of that length begins: so that it contains a cusp, if there is one. Elsewhere a path seldom has another
/// shape that is cheaper.
double AnytimeImprover::beginOfPart(const Track& track, double length) {
  const double last = track.length() - length;
  const std::vector<double> cusps = cuspsOf(track.arcs());
  if (cusps.empty()) return random_.uniform(0.0, last);
  const double cusp = cusps[static_cast<std::size_t>(random_.uniform() * static_cast<double>(cusps.size()))];
  return std::clamp(cusp - random_.uniform() * length, 0.0, last);
}

}  // namespace external_command
