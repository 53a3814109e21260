// SPDX-License-Identifier: Apache-2.0
#include "tour.h"

#include <algorithm>
#include <array>
#include <limits>

namespace external_command {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxPasses = 30;
constexpr long kMaxMoved = 3;   ///< pieces that are moved together
constexpr double kGain = 1e-3;  ///< smaller ones are rounding [m]

Step turned(const Step& step) { return {step.work, 1 - step.way}; }

}  // namespace

void Tour::build(std::vector<std::size_t> todo) {
  steps_.clear();
  while (!todo.empty()) {
    const Step next = nearest(todo);
    steps_.push_back(next);
    todo.erase(std::find(todo.begin(), todo.end(), next.work));
  }
}

/// Looks at those first that are nearest in a straight line: what is farther than the best price found need not be
/// priced, and that takes much longer than a distance. Of equal ones, the first of `todo`.
Step Tour::nearest(const std::vector<std::size_t>& todo) {
  struct Candidate {
    double bound;
    std::size_t order;
    Step step;
  };
  links_.field().poll();
  const Step* last = at(static_cast<long>(steps_.size()) - 1);
  std::vector<Candidate> candidates;
  for (const std::size_t work : todo) {
    for (std::size_t way = 0; way < works_[work].ways(); ++way) {
      const Step step{work, way};
      candidates.push_back({links_.bound(last, &step), candidates.size(), step});
    }
  }
  const auto farther = [](const Candidate& a, const Candidate& b) { return a.bound > b.bound; };
  std::make_heap(candidates.begin(), candidates.end(), farther);
  Candidate best = candidates.front();
  double best_price = kInfinity;
  for (auto end = candidates.end(); end != candidates.begin() && candidates.front().bound <= best_price; --end) {
    const Candidate& candidate = candidates.front();
    const double price = links_.price(last, &candidate.step);
    if (price < best_price || (price == best_price && candidate.order < best.order)) {
      best = candidate;
      best_price = price;
    }
    std::pop_heap(candidates.begin(), end, farther);
  }
  return best.step;
}

void Tour::improve(double until) {
  gaps_.assign(steps_.size() + 1, 0.0);
  measure(0, static_cast<long>(steps_.size()));
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const bool turned = turnParts(until), moved = moveParts(until);
    if (!turned && !moved) break;
  }
}

void Tour::measure(long first, long last) {
  for (long i = first; i <= last; ++i) gaps_[static_cast<std::size_t>(i)] = links_.price(at(i - 1), at(i));
}

/// Drives a part of the tour the other way round where that is shorter.
bool Tour::turnParts(double until) {
  bool improved = false;
  const long n = static_cast<long>(steps_.size());
  for (long i = 0; i < n && !isLate(until); ++i) {
    links_.field().poll();
    for (long j = i; j < n && canTurn(*at(j)); ++j) {
      const Step first = turned(*at(j)), last = turned(*at(i));
      const double before = gap(i) + gap(j + 1);
      if (links_.bound(at(i - 1), first, last, at(j + 1)) >= before) continue;
      const double after = links_.price(at(i - 1), &first) + links_.price(&last, at(j + 1));
      if (after > before - kGain) continue;
      std::reverse(steps_.begin() + i, steps_.begin() + j + 1);
      std::transform(steps_.begin() + i, steps_.begin() + j + 1, steps_.begin() + i, turned);
      measure(i, j + 1);
      improved = true;
    }
  }
  return improved;
}

bool Tour::moveParts(double until) {
  bool improved = false;
  const long n = static_cast<long>(steps_.size());
  for (long count = 1; count <= std::min(kMaxMoved, n - 1); ++count) {
    for (long i = 0; i + count <= n && !isLate(until); ++i) improved = movePart(i, count) || improved;
  }
  return improved;
}

/// Moves `count` pieces from `begin` on to another place, turned round or not, where that is shorter.
bool Tour::movePart(long begin, long count) {
  links_.field().poll();
  const auto first = steps_.begin() + begin;
  std::array<std::vector<Step>, 2> pieces = {std::vector<Step>(first, first + count), {}};
  const bool turns = std::all_of(first, first + count, [&](const Step& step) { return canTurn(step); });
  if (turns) std::transform(pieces[0].rbegin(), pieces[0].rend(), std::back_inserter(pieces[1]), turned);
  double best = links_.detour(at(begin - 1), *at(begin), *at(begin + count - 1), at(begin + count)) - kGain;
  long place = -2;
  const std::vector<Step>* chosen = nullptr;
  for (long j = -1; j < static_cast<long>(steps_.size()); ++j) {  // between j and j + 1
    if (j >= begin - 1 && j < begin + count) continue;
    for (const std::vector<Step>& piece : pieces) {
      if (piece.empty()) continue;
      if (links_.bound(at(j), piece.front(), piece.back(), at(j + 1)) >= best + gap(j + 1)) continue;
      const double price = links_.detour(at(j), piece.front(), piece.back(), at(j + 1));
      if (price < best) best = price, place = j, chosen = &piece;
    }
  }
  if (chosen == nullptr) return false;
  steps_.erase(first, first + count);
  steps_.insert(steps_.begin() + (place < begin ? place + 1 : place + 1 - count), chosen->begin(), chosen->end());
  measure(std::min(begin, place + 1), std::max(begin + count, place + 1));
  return true;
}

Insertion cheapestInsertion(Links* links, const std::vector<Work>& works, std::size_t work,
                            const std::vector<Step>& steps) {
  links->field().poll();
  Insertion best{kInfinity, 0, {}};
  for (long j = -1; j < static_cast<long>(steps.size()); ++j) {
    const Step *before = stepAt(steps, j), *after = stepAt(steps, j + 1);
    const double gap = links->price(before, after);
    for (std::size_t way = 0; way < works[work].ways(); ++way) {
      const Step step{work, way};
      if (links->bound(before, step, step, after) >= best.price + gap) continue;
      const double price = links->detour(before, step, step, after);
      if (price < best.price) best = {price, static_cast<std::size_t>(j + 1), step};
    }
  }
  return best;
}

}  // namespace external_command
