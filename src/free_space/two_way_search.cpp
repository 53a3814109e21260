// SPDX-License-Identifier: Apache-2.0
#include "two_way_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace external_command {

namespace {

/// Levels for a turning radius of 1. The finest one ends a search of a tight place for good.
constexpr std::array<SearchLevel, 5> kLevels{{{0.15, 2.0 * M_PI / 48, 0.20, 20'000},
                                              {0.06, 2.0 * M_PI / 96, 0.10, 60'000},
                                              {0.025, 2.0 * M_PI / 192, 0.05, 300'000},
                                              {0.01, 2.0 * M_PI / 384, 0.02, 600'000},
                                              {0.004, 2.0 * M_PI / 1024, 0.008, 1'000'000}}};

/// Once a path is known, the search goes on for this part of its steps: the first path is seldom the cheapest.
constexpr double kGoOn = 0.5;
constexpr std::size_t kGoOnSteps = 10;

}  // namespace

TwoWaySearch::TwoWaySearch(const Scene& scene, const Query& query, const BoundingBox& area)
    : scene_(scene),
      backward_scene_{scene.index, scene.radius, scene.cost.reversed()},
      to_goal_(scene.index, area, query.goal),
      to_start_(scene.index, area, query.start),
      from_start_(scene_, query.start, 0, to_goal_),
      from_goal_(backward_scene_, query.goal, -query.gear_after, to_start_) {}

SearchLevel TwoWaySearch::levelFor(std::size_t i, const Variant& variant) const {
  SearchLevel level = kLevels[i];
  level.cell *= scene_.radius;
  level.stride *= scene_.radius * variant.stride_factor;
  level.weight = variant.weight;
  level.shift = variant.shift;
  return level;
}

void TwoWaySearch::keep(const Connection& connection, bool from_start) {
  const SearchTree& own = from_start ? from_start_ : from_goal_;
  const SearchTree& other = from_start ? from_goal_ : from_start_;
  Arcs arcs = own.arcsTo(connection.node);
  append(connection.word, &arcs);
  const Arcs rest = reversed(other.arcsTo(connection.other_node));
  arcs.insert(arcs.end(), rest.begin(), rest.end());
  arcs_ = merged(from_start ? arcs : reversed(arcs));
}

TwoWaySearch::Outcome TwoWaySearch::run(const Variant& variant, const Limits& limits) {
  const std::array<SearchTree*, 2> trees{&from_start_, &from_goal_};
  std::array<std::size_t, 2> levels{variant.first_level, variant.first_level};
  for (SearchTree* tree : trees) tree->restart(levelFor(variant.first_level, variant));
  bool found = false;
  double max_cost = limits.max_cost;
  for (std::size_t step = 0, last = limits.max_steps; step < last; ++step) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::optional<Connection> connection = trees[side]->step(trees[1 - side], &max_cost);
      if (!connection) continue;
      keep(*connection, side == 0);
      if (!found) last = std::min(last, step + kGoOnSteps + static_cast<std::size_t>(kGoOn * static_cast<double>(step)));
      found = true;
    }
    if (limits.stop()) return found ? Outcome::kFound : Outcome::kStopped;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!trees[side]->isExhausted()) continue;
      if (found) return Outcome::kFound;
      if (levels[side] + 1 < kLevels.size()) {
        trees[side]->restart(levelFor(++levels[side], variant));
      } else if (trees[side]->isEmpty()) {
        return Outcome::kNone;
      } else if (trees[1 - side]->isExhausted()) {
        return Outcome::kOutOfSteps;
      }
    }
  }
  return found ? Outcome::kFound : Outcome::kOutOfSteps;
}

}  // namespace external_command
