// SPDX-License-Identifier: Apache-2.0
#include "anytime_improver.h"

namespace external_command {

namespace {

constexpr std::size_t kFirstPatience = 2000;
constexpr std::size_t kPatience = 1000;     ///< in the first round
constexpr std::size_t kMorePatience = 500;  ///< in each further round
constexpr std::size_t kSearchSteps = 8000;  ///< of one search
constexpr double kWorthImproving = 1.1;     ///< times the best cost: a fresh path becomes about this much cheaper

}  // namespace

AnytimeImprover::AnytimeImprover(const Scene& scene, const Query& query, const BoundingBox& area, std::uint64_t seed)
    : scene_(scene), query_(query), area_(area), random_(seed), improver_(scene, query, random_.bits()) {}

Arcs AnytimeImprover::improve(const Arcs& arcs, WorkBudget* budget) {
  const auto costs = [&](const Arcs& path) { return costOf(path, scene_.cost, query_.gear_after); };
  Arcs best = improver_.improve(arcs, kFirstPatience, budget);
  if (budget->isUsedUp() || best.empty()) return best;
  TwoWaySearch search(scene_, query_, area_);
  for (std::size_t round = 0; !budget->isUsedUp(); ++round) {
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

}  // namespace external_command
