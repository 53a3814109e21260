// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "coverage/work/laps.h"
#include "draft.h"
#include "plan.h"

namespace external_command {

namespace {

constexpr double kTimeForTrying = 0.4;     ///< share of the budget after which no further plan is tried
constexpr double kTimeForSettling = 0.65;  ///< the same for settling one
constexpr double kHopeless = 0.93;         ///< share swept below which only much dearer area can help
constexpr double kHole = 60.0;             ///< squares of a swath's width that take as long to plan as a hole
constexpr double kSmallHole = 20.0;        ///< the same of one that swaths bend round
constexpr double kEqual = 1e-9;            ///< plans with costs as near as that are the same

/// How much is tried: the less, the longer one plan takes.
struct Effort {
  std::vector<double> prices;          ///< of a square metre that is not swept, times the swath width, rising
  std::size_t first = 0;               ///< of the prices
  std::size_t drafts = 1;              ///< numbers of laps for each
  std::vector<double> choosy = {1.0};  ///< as worksOf()
  long finalists = 1;                  ///< plans that are settled, for each swing
  int rounds = 1;                      ///< as settled()
  bool divides = false;                ///< whether swaths in several directions are tried
};

double holesIn(const shapes::Shapes& area) {
  std::size_t holes = 0;
  for (const shapes::Shape& shape : area) holes += shape.inners().size();
  return static_cast<double>(holes);
}

/// The area in squares of a swath's width, and its holes.
double sizeOf(const Field& field, double area) {
  const double large = holesIn(field.passable()), all = holesIn(field.workable());
  return area / (field.width() * field.width()) + kHole * large + kSmallHole * (all - large);
}

/// @param size  as sizeOf().
Effort effortFor(double size) {
  if (size < 1500.0) return {{3.0, 4.0, 6.0, 8.0, 12.0, 20.0}, 1, 3, {1.0, 3.0}, 4, 18, true};
  if (size < 3000.0) return {{3.0, 5.0, 8.0, 12.0, 20.0}, 1, 2, {1.0, 4.0}, 3, 15, true};
  if (size < 5000.0) return {{3.0, 5.0, 8.0, 12.0, 20.0}, 1, 2, {1.0}, 2, 12, true};
  return {{4.0}, 0, 2, {1.0}, 1, 1};
}

/// Tries plans, and looks closely at the best ones.
class Contest {
 public:
  explicit Contest(const Field& field)
      : field_(field),
        guide_(field),
        empty_(field.makeGrid()),
        goal_(std::max(empty_.area(kGoal, 0), 1e-9)),
        effort_(effortFor(sizeOf(field, goal_))) {}

  Plan run() {
    tryPrices();
    Entry best;
    for (Entry& entry : entries_) {
      if (!best.plan.steps.empty() && field_.timeUsed() > kTimeForSettling) break;
      Plan plan = settled(field_, std::move(entry.plan), effort_.rounds, &guide_);
      const double cost = costOf(field_, plan.effort, plan.length, plan.covered, goal_);
      const bool is_better = best.plan.steps.empty() || (!plan.steps.empty() && cost < best.cost);
      if (is_better) best = {std::move(plan), cost, entry.swing};
    }
    return std::move(best.plan);
  }

 private:
  struct Entry {
    Plan plan;
    double cost = 0.0;
    double swing = 0.0;  ///< of its laps: whether a way leads to laps near the border only settling shows
  };

  /// Dearer area first as long as too much stays unswept; then cheaper area as long as that makes it better. Where
  /// far too much does, from the dearest down.
  void tryPrices() {
    const auto& prices = effort_.prices;
    std::size_t last = effort_.first;
    bool is_better = tryPrice(prices[last]);
    if (isHopeless()) {
      for (std::size_t i = prices.size(); --i > last && isTimeLeft() && tryPrice(prices[i]);) {
      }
      return;
    }
    while (last + 1 < prices.size() && (is_better || isFarShort()) && isShort() && isTimeLeft()) {
      is_better = tryPrice(prices[++last]);
    }
    for (std::size_t i = effort_.first; i-- > 0 && last == effort_.first;) {
      if (!tryPrice(prices[i])) break;
    }
  }

  bool isTimeLeft() const { return field_.timeUsed() < kTimeForTrying; }

  /// The best plan's, for the swing that comes out worse.
  double bestShare() const {
    double least = 1.0;
    for (const double swing : swingsOf(field_)) {
      const auto isAlike = [&](const Entry& entry) { return entry.swing == swing; };
      const auto best = std::find_if(entries_.begin(), entries_.end(), isAlike);
      if (best != entries_.end()) least = std::min(least, best->plan.covered / goal_);
    }
    return least;
  }

  bool isShort() const { return bestShare() < field_.params().target_coverage; }
  bool isFarShort() const { return bestShare() < kLowCoverage; }
  bool isHopeless() const { return bestShare() < kHopeless; }

  /// @return whether that is the best so far, with its swing.
  bool tryPrice(double share) {
    const double price = share / field_.width();
    bool improved = false;
    tried_.clear();
    std::vector<Draft> drafts = makeDrafts(field_, empty_, price, effort_.drafts);
    for (Draft& laps : draftsOfLaps(field_, empty_, price)) drafts.insert(drafts.begin(), std::move(laps));
    for (const Draft& draft : drafts) {
      for (const double choosy : effort_.choosy) {
        if (!entries_.empty() && field_.timeUsed() > kTimeForTrying) return false;
        improved = tryWorks(worksOf(field_, draft, price, choosy), price, draft.swing) || improved;
      }
      if (isHopeless() && share < effort_.prices.back()) break;
      improved = tryParts(draft, price) || improved;
    }
    return improved;
  }

  /// @return whether that is the best so far, with its swing.
  bool tryParts(const Draft& draft, double price) {
    if (!effort_.divides || !isTimeLeft()) return false;
    const auto [parts, is_new] = parts_.try_emplace({draft.laps, draft.swing});
    if (is_new) parts->second = partsOf(field_, draft, price);
    if (parts->second.size() < 2) return false;
    return tryWorks(worksOf(field_, draft, price, parts->second), price, draft.swing);
  }

  /// Different drafts, and swaths chosen in different ways, often come to the same works.
  /// @return whether that is the best so far, with its swing.
  bool tryWorks(std::vector<Work> works, double price, double swing) {
    const auto isSame = [&](const std::vector<Work>& other) {
      return std::equal(works.begin(), works.end(), other.begin(), other.end());
    };
    if (std::any_of(tried_.begin(), tried_.end(), isSame)) return false;
    tried_.push_back(works);
    return enter(planOf(field_, std::move(works), price, &guide_), swing);
  }

  /// @return whether that is the best so far, with its swing.
  bool enter(Plan plan, double swing) {
    const double cost = costOf(field_, plan.effort, plan.length, plan.covered, goal_);
    const auto better = [&](const Entry& entry) { return entry.cost <= cost; };
    const auto equal = [&](const Entry& entry) { return std::abs(entry.cost - cost) < kEqual; };
    const auto alike = [&](const Entry& entry) { return entry.swing == swing; };
    const auto place = std::find_if_not(entries_.begin(), entries_.end(), better);
    const bool is_best = std::none_of(entries_.begin(), place, alike);
    if (std::any_of(entries_.begin(), entries_.end(), equal)) return false;
    entries_.insert(place, {std::move(plan), cost, swing});
    if (std::count_if(entries_.begin(), entries_.end(), alike) > effort_.finalists) {
      entries_.erase(std::find_if(entries_.rbegin(), entries_.rend(), alike).base() - 1);
    }
    return is_best;
  }

  const Field& field_;
  Guide guide_;
  CoverageGrid empty_;
  double goal_;
  Effort effort_;
  std::map<std::pair<int, double>, std::vector<Part>> parts_;  ///< by laps and swing: the price hardly matters
  std::vector<Entry> entries_;                                 ///< the best ones, best first
  std::vector<std::vector<Work>> tried_;                       ///< for the present price
};

}  // namespace

Plan bestPlan(const Field& field) { return Contest(field).run(); }

}  // namespace external_command
