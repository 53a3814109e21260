// SPDX-License-Identifier: Apache-2.0
#include "two_way_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace external_command {

namespace {

/// Levels for a turning radius of 1. The finest one ends a search of a tight place for good. Finer ones are there to
/// get out of a tight place at all, so gear changes matter less to them.
constexpr std::array<SearchLevel, 5> kLevels{{{0.15, 2.0 * M_PI / 48, 0.20, 12'000, 1.0},
                                              {0.06, 2.0 * M_PI / 96, 0.10, 36'000, 0.7},
                                              {0.025, 2.0 * M_PI / 192, 0.05, 180'000, 0.4},
                                              {0.01, 2.0 * M_PI / 384, 0.02, 600'000, 0.2},
                                              {0.004, 2.0 * M_PI / 1024, 0.008, 1'000'000, 0.1}}};

/// Once a path is known, the search goes on for this part of its steps: the first path is seldom the cheapest.
constexpr double kGoOn = 0.8;
constexpr std::size_t kGoOnSteps = 20;

/// Each so many steps it is the larger tree's turn.
constexpr std::size_t kOtherTurn = 16;

}  // namespace

TwoWaySearch::TwoWaySearch(const Scene& scene, const Query& query, const BoundingBox& area)
    : scene_(scene),
      backward_scene_{scene.index, scene.radius, scene.cost.reversed()},
      to_goal_(scene.index, area, query.goal),
      to_start_(scene.index, area, query.start),
      from_start_(scene_, query.start, query.junctions.before, to_goal_),
      from_goal_(backward_scene_, query.goal, -query.junctions.after, to_start_) {}

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
  levels_ = {variant.first_level, variant.first_level};
  const std::array<SearchTree*, 2> trees{&from_start_, &from_goal_};
  for (SearchTree* tree : trees) tree->restart(levelFor(variant.first_level, variant));
  bool found = false;
  double max_cost = limits.max_cost;
  for (std::size_t step = 0, last = limits.max_steps; step < last; ++step) {
    const std::size_t side = sideOf(step);
    SearchTree *tree = trees[side], *other = trees[1 - side];
    if (const std::optional<Connection> connection = tree->step(other, &max_cost)) {
      keep(*connection, side == 0);
      if (!found)
        last = std::min(last, step + kGoOnSteps + static_cast<std::size_t>(kGoOn * static_cast<double>(step)));
      found = true;
    }
    if (limits.stop()) return found ? Outcome::kFound : Outcome::kStopped;
    if (!tree->isExhausted()) continue;
    if (found) return Outcome::kFound;
    if (levels_[side] + 1 < kLevels.size()) {
      tree->restart(levelFor(++levels_[side], variant));
    } else if (tree->isEmpty()) {
      return Outcome::kNone;
    } else if (other->isExhausted()) {
      return Outcome::kOutOfSteps;
    }
  }
  return found ? Outcome::kFound : Outcome::kOutOfSteps;
}

/// The end with fewer nodes to grow is the tighter one, and the cheaper one to search.
std::size_t TwoWaySearch::sideOf(std::size_t step) const {
  const std::size_t smaller = from_goal_.waiting() < from_start_.waiting() ? 1 : 0;
  const std::size_t side = step % kOtherTurn == 0 ? 1 - smaller : smaller;
  const bool is_given_up = side == 0 ? from_start_.isExhausted() : from_goal_.isExhausted();
  return is_given_up ? 1 - side : side;
}

}  // namespace external_command
