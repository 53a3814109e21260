// SPDX-License-Identifier: Apache-2.0
#include "anytime_improver.h"

#include <algorithm>

#include "free_space/search/search_box.h"
#include "track.h"

namespace external_command {

namespace {

constexpr std::size_t kFirstPatience = 2000;
constexpr std::size_t kPatience = 1000;     ///< in the first round
constexpr std::size_t kMorePatience = 500;  ///< in each further round
constexpr std::size_t kSearchSteps = 8000;  ///< of one search
constexpr double kLongWay = 20.0;           ///< of which parts are searched anew, in turning radii
constexpr double kWindow = 12.0;            ///< such a part, in turning radii; half to one and a half times that
constexpr double kAround = 3.0;             ///< a part, in turning radii
constexpr std::size_t kWindowSteps = 2500;  ///< of the search for a part
constexpr std::size_t kWindows = 4;         ///< in one round
constexpr double kWorthImproving = 1.1;     ///< times the best cost: a fresh path becomes about this much cheaper

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
  Arcs best = improver_.improve(arcs, kFirstPatience, budget);
  if (budget->isUsedUp() || best.empty()) return best;
  TwoWaySearch search(scene_, query_, area_);
  for (std::size_t round = 0; !budget->isUsedUp(); ++round) {
    if (lengthOf(best) > kLongWay * scene_.radius) {
      for (std::size_t i = 0; i < kWindows && !budget->isUsedUp(); ++i) best = windowSearched(best, budget);
      best = improver_.improve(best, kPatience + round * kMorePatience, budget);
      if (round % 4 != 0) continue;
    }
    const TwoWaySearch::Variant variant{round % 2, random_.uniform(1.0, 1.6), random_.uniform(0.7, 1.3),
                                        random_.uniform()};
    const TwoWaySearch::Limits limits{kSearchSteps, kWorthImproving * costs(best), [&] { return !budget->spend(); }};
    const std::size_t patience = kPatience + round * kMorePatience;
    if (search.run(variant, limits) == TwoWaySearch::Outcome::kFound) {
      const Arcs other = improver_.improve(search.arcs(), patience, budget);
      if (costs(other) < costs(best)) best = other;
    }
    best = improver_.improve(best, patience, budget);
  }
  return best;
}

/// The path with a part of it replaced by a cheaper one, or as it was.
Arcs AnytimeImprover::windowSearched(const Arcs& arcs, WorkBudget* budget) {
  const Track track(query_, arcs, cost_);
  const double length = std::min(random_.uniform(0.5, 1.5) * kWindow * scene_.radius, track.length());
  const double begin = random_.uniform(0.0, track.length() - length);
  const Track::Place from = track.arriving(begin), to = track.leaving(begin + length);
  std::vector<Point2d> points{from.pose.position(), to.pose.position()};
  for (double s = begin; s < begin + length; s += scene_.radius) points.push_back(track.leaving(s).pose.position());
  TwoWaySearch search(scene_, {from.pose, to.pose, {from.gear, to.gear, from.kappa, to.kappa}},
                      searchBox(points, kAround * scene_.radius, area_));
  const TwoWaySearch::Variant variant{0, random_.uniform(1.0, 1.6), random_.uniform(0.7, 1.3), random_.uniform()};
  const TwoWaySearch::Limits limits{kWindowSteps, to.cost - from.cost, [&] { return !budget->spend(); }};
  if (search.run(variant, limits) != TwoWaySearch::Outcome::kFound) return arcs;
  const Arcs other = track.spliced(from, search.arcs(), to);
  return cost_.of(query_.start, other, query_.junctions) < track.cost() ? other : arcs;
}

}  // namespace external_command
