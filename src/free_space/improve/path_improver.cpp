// SPDX-License-Identifier: Apache-2.0
#include "path_improver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace external_command {

namespace {

constexpr double kCheckStep = 0.05;      ///< most that a corner moves between two checks of the first look [m]
constexpr double kProgress = 1e-3;       ///< part of the cost that has to be won to go on
constexpr double kWorthIt = 1e-4;        ///< smallest gain that counts [m]
constexpr double kShortestPiece = 1e-3;  ///< [m]
constexpr double kShortcuts = 0.2;       ///< part of the trials

}  // namespace

PathImprover::PathImprover(const Scene& scene, const DrivingCost& cost, const Query& query, std::uint64_t seed)
    : scene_(scene), cost_(cost), query_(query), random_(seed) {}

Arcs PathImprover::improve(const Arcs& arcs, std::size_t patience, WorkBudget* budget) {
  if (arcs.empty()) return arcs;
  Track track(query_, arcs, cost_);
  double milestone = track.cost();
  for (std::size_t fruitless = 0; fruitless < patience && budget->spend(); ++fruitless) {
    const std::optional<Arcs> better = tryOnce(track);
    if (!better) continue;
    if (better->empty()) return *better;
    Track next(query_, *better, cost_);
    if (next.cost() > track.cost() - kWorthIt / 2.0) continue;  // parts of arcs were charged for closeness by guess
    track = std::move(next);
    if (track.cost() < milestone * (1.0 - kProgress)) fruitless = 0, milestone = track.cost();
  }
  return track.arcs();
}

std::optional<Arcs> PathImprover::tryOnce(const Track& track) {
  const double middle = random_.uniform(0.0, track.length());
  const auto reach = [&] { return track.length() * std::pow(random_.uniform(), 2.0); };
  const Track::Place from = track.arriving(std::max(middle - reach(), 0.0));
  const Track::Place to = track.leaving(std::min(middle + reach(), track.length()));
  if (to.s - from.s < kShortestPiece) return std::nullopt;
  if (random_.uniform() < kShortcuts) return tryShortcut(track, from, to);
  const double size = std::pow(10.0, random_.uniform(-3.0, 0.0)) * scene_.radius / 3.0;
  Pose2d via = track.leaving(middle).pose;
  via.x += size * random_.bell();
  via.y += size * random_.bell();
  via.heading += size * random_.bell() / scene_.radius;
  return tryVia(track, from, via, to);
}

std::optional<Arcs> PathImprover::tryShortcut(const Track& track, const Track::Place& from,
                                              const Track::Place& to) const {
  if (from.arc == to.arc) return std::nullopt;
  WordSet words;
  const double budget = to.cost - from.cost - kWorthIt;
  reedsSheppWords(from.pose, to.pose, wordQuery(from.gear, from.kappa, to, budget), &words);
  while (words.size() > 0) {
    const SteeringWord word = words.takeCheapest();
    if (costOf(from.pose, word) > budget || !isDrivable(from.pose, word)) continue;
    Arcs middle;
    append(word, &middle);
    return track.spliced(from, middle, to);
  }
  return std::nullopt;
}

std::optional<Arcs> PathImprover::tryVia(const Track& track, const Track::Place& from, const Pose2d& via,
                                         const Track::Place& to) const {
  const double budget = to.cost - from.cost - kWorthIt;
  WordSet first_words, second_words;
  reedsSheppWords(from.pose, via, {scene_.radius, cost_.ofArcs(), {from.gear, 0, from.kappa, 0.0}, budget},
                  &first_words);
  if (first_words.size() == 0 || !scene_.index.isFree(via)) return std::nullopt;
  while (first_words.size() > 0) {
    const SteeringWord first = first_words.takeCheapest();
    if (first.size == 0) continue;
    const ArcSegment& last = first.arcs[static_cast<std::size_t>(first.size) - 1];
    const double left = budget - costOf(from.pose, first);
    reedsSheppWords(via, to.pose, wordQuery(gearOf(last), last.kappa, to, left), &second_words);
    if (second_words.size() == 0 || !isDrivable(from.pose, first)) continue;
    while (second_words.size() > 0) {
      const SteeringWord second = second_words.takeCheapest();
      if (costOf(via, second) > left || !isDrivable(via, second)) continue;
      Arcs middle;
      append(first, &middle);
      append(second, &middle);
      return track.spliced(from, middle, to);
    }
  }
  return std::nullopt;
}

double PathImprover::costOf(const Pose2d& from, const SteeringWord& word) const {
  return word.cost + cost_.ofCloseness(from, word);
}

WordQuery PathImprover::wordQuery(int gear, double kappa, const Track::Place& to, double budget) const {
  return {scene_.radius, cost_.ofArcs(), {gear, to.gear, kappa, to.kappa}, budget};
}

bool PathImprover::isDrivable(const Pose2d& from, const SteeringWord& word) const {
  return isFree(scene_.index, from, word, kCheckStep) && keepsMargin(scene_.index, from, word);
}

}  // namespace external_command
