// SPDX-License-Identifier: Apache-2.0
#include "plan.h"

#include <algorithm>
#include <cstdint>

#include "coverage/field/tally.h"
#include "coverage/field/uncovered.h"
#include "coverage/work/swaths.h"
#include "tour.h"

namespace external_command {

namespace {

constexpr double kDear = 12.0;  ///< price of a square metre, times the width, for which the last swaths are looked for
constexpr int kMostDead = 10;   ///< rounds of leaving out what no way leads to
constexpr double kTimeForOrder = 0.45;    ///< share of the budget after which an order not settled is improved no more
constexpr double kTimeForChanges = 0.65;  ///< the same after which a plan is settled as it is
constexpr double kTimeForGaps = 0.68;     ///< the same for the gaps
constexpr double kMoreForGaps = 0.02;     ///< of length, as share
constexpr int kRoundsForGaps = 3;         ///< of refining once the gaps are filled
constexpr int kRounds = 4;                ///< of swaths for what is left
constexpr double kCheapTurn = 0.3;        ///< price of a turn in their search, in radii: the tour knows the real one
constexpr double kGapTurn = 3.0;          ///< the same in the search for swaths in a gap: a strip is not swept across

class Planner {
 public:
  Planner(const Field& field, Plan plan, Guide* guide)
      : field_(field),
        plan_(std::move(plan)),
        links_(field, plan_.works, guide),
        tally_(field.makeGrid(), field.width()),
        goal_(std::max(tally_.grid().area(kGoal, 0), 1e-9)) {}

  Plan make() {
    order();
    count();
    leaveOut();
    putIn(kTimeForOrder);
    chooseWays();
    return finish();
  }

  Plan settle(int rounds) {
    is_settled_ = true;
    count();
    refine(rounds);
    if (rounds > 1 && field_.timeUsed() < kTimeForChanges) {
      putIn(kTimeForChanges);
      refine(rounds);
    }
    fillGaps();
    is_filled_ = true;
    refine(std::min(rounds, kRoundsForGaps));
    plan_.links.clear();
    for (long i = 0; at(i) != nullptr; ++i) plan_.links.push_back(links_.way(at(i - 1), at(i)));
    return finish();
  }

 private:
  Plan finish() {
    plan_.covered = tally_.covered();
    plan_.length = length();
    plan_.effort = effort();
    return std::move(plan_);
  }

  void count() {
    for (const Step& step : plan_.steps) tally_.add(wayOf(step));
  }

  /// @return whether any way is not what it was taken for.
  bool settleLinks() {
    bool changed = false;
    for (long i = 0; at(i) != nullptr; ++i) changed = links_.settle(at(i - 1), at(i)) || changed;
    return changed;
  }

  /// Makes the plan better by what is known of the ways, and leaves out what none leads to.
  void refine(int rounds) {
    best_.clear();
    for (int round = 0; round < rounds && (settleLinks() || round == 0); ++round) {
      remember();
      if (field_.timeUsed() > kTimeForChanges) break;
      links_.doubtGuesses();
      improve();
      chooseWays();
      leaveOut();
    }
    for (int round = 0; round < kMostDead && settleLinks(); ++round) {
      remember();
      leaveOut();
    }
    recall();
  }

  double cost() { return costOf(field_, effort(), length(), tally_.covered(), goal_); }

  /// The plan as it is, where it is the best one so far of which every way is known.
  void remember() {
    if (!best_.empty() && cost() >= best_cost_) return;
    best_cost_ = cost();
    best_ = plan_.steps;
  }

  /// A change may turn out worse than what it was made of, once its ways are known.
  void recall() {
    if (best_.empty() || cost() <= best_cost_) return;
    for (const Step& step : plan_.steps) tally_.remove(wayOf(step));
    plan_.steps = best_;
    count();
  }

  bool isBorderLap(const Step& step) const {
    const Work& work = plan_.works[step.work];
    return work.lap >= 0 && !work.is_ring;
  }

  /// The order of what comes after the laps along the border.
  void improve() {
    if (!field_.params().headland_first) return;
    auto first = plan_.steps.end();
    while (first != plan_.steps.begin() && !isBorderLap(*(first - 1))) --first;
    Tour tour(&links_, plan_.works, first == plan_.steps.begin() ? std::nullopt : std::optional<Step>(*(first - 1)));
    tour.take({first, plan_.steps.end()});
    tour.improve(kTimeForChanges);
    for (auto step = first; step != plan_.steps.end(); ++step) tally_.remove(wayOf(*step));
    std::copy(tour.steps().begin(), tour.steps().end(), first);
    for (auto step = first; step != plan_.steps.end(); ++step) tally_.add(wayOf(*step));
  }

  /// Begins each closed lap where that suits what comes before and after it.
  void chooseWays() {
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      Step& step = plan_.steps[i];
      if (!plan_.works[step.work].isClosed()) continue;
      const Step *before = at(static_cast<long>(i) - 1), *after = at(static_cast<long>(i) + 1);
      const Step old = step;
      double best = links_.price(before, &step) + links_.price(&step, after);
      for (std::size_t way = 0; way < plan_.works[old.work].ways(); ++way) {
        const Step other{old.work, way};
        if (links_.bound(before, other, other, after) >= best) continue;
        const double price = links_.price(before, &other) + links_.price(&other, after);
        if (price < best) best = price, step = other;
      }
      if (step.way == old.way) continue;
      tally_.remove(wayOf(old));
      tally_.add(wayOf(step));
    }
  }

  const Step* at(long i) const { return stepAt(plan_.steps, i); }
  Curve wayOf(const Step& step) const { return plan_.works[step.work].curveOf(step.way); }

  /// Laps along the border before or after the swaths, rings around holes where they cost least.
  void order() {
    std::vector<std::size_t> swaths, rings, laps;
    for (std::size_t i = 0; i < plan_.works.size(); ++i) {
      const Work& work = plan_.works[i];
      (work.lap < 0 ? swaths : work.is_ring ? rings : laps).push_back(i);
    }
    if (!field_.params().headland_first) std::swap(laps, swaths);
    for (const auto& part : {laps, swaths}) {
      Tour tour(&links_, plan_.works, plan_.steps.empty() ? std::nullopt : std::optional<Step>(plan_.steps.back()));
      tour.build(part);
      tour.improve(kTimeForOrder);
      plan_.steps.insert(plan_.steps.end(), tour.steps().begin(), tour.steps().end());
    }
    for (const std::size_t ring : rings) insert(cheapestInsertion(&links_, plan_.works, ring, plan_.steps));
  }

  void insert(const Insertion& insertion) {
    plan_.steps.insert(plan_.steps.begin() + static_cast<long>(insertion.place), insertion.step);
  }

  double length() {
    double sum = 0.0;
    for (long i = 0; at(i) != nullptr; ++i) sum += links_.length(at(i - 1), at(i)) + plan_.works[at(i)->work].length();
    return sum;
  }

  double effort() {
    double sum = 0.0;
    for (long i = 0; at(i) != nullptr; ++i) sum += links_.price(at(i - 1), at(i)) + effortOf(*at(i));
    return sum;
  }

  double effortOf(const Step& step) const {
    const Curve way = wayOf(step);
    return way.length() + field_.gearPrice() * way.gearChanges();
  }

  /// Whether so much effort and length [m] are worth so much area [m^2]; all negative if it is to be left out.
  bool pays(double more_effort, double more_length, double more_area) {
    if (!is_settled_) return plan_.price * more_area > more_effort;
    const double now = length(), so_far = effort(), covered = tally_.covered();
    return costOf(field_, so_far + more_effort, now + more_length, covered + more_area, goal_) <
           costOf(field_, so_far, now, covered, goal_);
  }

  void leaveOut() {
    for (bool changed = true; changed;) {
      changed = false;
      for (long i = 0; at(i) != nullptr; ++i) {
        field_.poll();
        const Step step = *at(i);
        const Curve way = wayOf(step);
        const double saved = effortOf(step) + links_.detour(at(i - 1), step, step, at(i + 1));
        const double shorter = way.length() + links_.longer(at(i - 1), step, at(i + 1));
        if (!pays(-saved, -shorter, -tally_.only(way))) continue;
        const bool is_wished =
            (isBorderLap(step) && field_.params().headland_laps > 0) || (is_filled_ && opensGap(way));
        if (is_wished && saved < Links::kNoWay / 2.0) continue;
        tally_.remove(way);
        plan_.steps.erase(plan_.steps.begin() + i--);
        changed = true;
      }
    }
  }

  /// @param until  share of the budget after which nothing more is put in.
  void putIn(double until) {
    const SwathPrices prices{is_settled_ ? std::max(plan_.price, kDear / field_.width()) : plan_.price,
                             kCheapTurn * field_.radius()};
    bool changed = true;
    for (int round = 0; round < kRounds && changed && field_.timeUsed() < until; ++round) {
      field_.poll();
      changed = false;
      CoverageGrid grid = tally_.grid();
      const auto headings = rankHeadings(field_, prices, grid, swathHeadings(field_));
      for (const Work& work : planSwaths(field_, prices, headings, &grid)) {
        if (field_.timeUsed() > until) break;
        plan_.works.push_back(work);
        const Insertion insertion = cheapestInsertion(&links_, plan_.works, plan_.works.size() - 1, plan_.steps);
        const Curve way = work.curveOf(insertion.step.way);
        const auto place = static_cast<long>(insertion.place);
        const double longer = way.length() + links_.longer(at(place - 1), insertion.step, at(place));
        if (!pays(effortOf(insertion.step) + insertion.price, longer, tally_.gain(way))) continue;
        tally_.add(way);
        insert(insertion);
        changed = true;
      }
    }
  }

  /// From how large a piece on nothing is left unswept [m^2]; 0: any may be.
  double gap() const { return field_.params().max_gap * field_.width() * field_.width(); }

  /// Whether such a piece would be left without `way`, which is in the plan.
  bool opensGap(const Curve& way) {
    if (gap() <= 0.0) return false;
    const UnsweptPart cells = tally_.cellsOnly(way);
    tally_.remove(way);
    const bool opens = !unsweptParts(tally_.grid(), gap(), cells).empty();
    tally_.add(way);
    return opens;
  }

  /// Sweeps the larger pieces that are left, whether that pays or not, largest first.
  void fillGaps() {
    if (gap() <= 0.0) return;
    std::vector<UnsweptPart> parts = unsweptParts(tally_.grid(), gap());
    const auto larger = [](const UnsweptPart& a, const UnsweptPart& b) { return a.size() > b.size(); };
    std::stable_sort(parts.begin(), parts.end(), larger);
    double more = kMoreForGaps * length();
    for (const UnsweptPart& part : parts) {
      if (field_.timeUsed() > kTimeForGaps) break;
      fillGap(part, &more);
    }
  }

  /// @param more  length that may be added [m]; less afterwards.
  void fillGap(const UnsweptPart& part, double* more) {
    CoverageGrid grid = tally_.grid();
    std::uint8_t* const cells = grid.data();
    for (std::size_t i = 0; i < grid.size(); ++i) cells[i] |= kSwept;
    for (const auto& [column, row] : part) {
      *(cells + (grid.row(row) - grid.row(0)) + column) &= static_cast<std::uint8_t>(~kSwept);
    }
    const SwathPrices prices{kDear / field_.width(), kGapTurn * field_.radius()};
    const auto headings = rankHeadings(field_, prices, grid, swathHeadings(field_));
    std::vector<Work> works = planSwaths(field_, prices, headings, &grid);
    std::stable_sort(works.begin(), works.end(), [](const Work& a, const Work& b) { return a.length() > b.length(); });
    for (const Work& work : works) {
      if (unsweptParts(tally_.grid(), gap(), part).empty()) break;
      plan_.works.push_back(work);
      const Insertion insertion = cheapestInsertion(&links_, plan_.works, plan_.works.size() - 1, plan_.steps);
      const auto place = static_cast<long>(insertion.place);
      links_.settle(at(place - 1), &insertion.step);
      links_.settle(&insertion.step, at(place));
      const Curve way = work.curveOf(insertion.step.way);
      const double longer = way.length() + links_.longer(at(place - 1), insertion.step, at(place));
      if (longer > *more) continue;
      *more -= longer;
      tally_.add(way);
      insert(insertion);
    }
  }

  const Field& field_;
  Plan plan_;
  Links links_;
  Tally tally_;
  double goal_;             ///< [m^2]
  bool is_filled_ = false;  ///< gaps are filled, and none is opened
  std::vector<Step> best_;  ///< as remember()
  double best_cost_ = 0.0;
  bool is_settled_ = false;  ///< whether the lengths of the ways between are known
};

}  // namespace

Plan planOf(const Field& field, std::vector<Work> works, double price, Guide* guide) {
  Plan plan;
  plan.works = std::move(works);
  plan.price = price;
  return Planner(field, std::move(plan), guide).make();
}

Plan settled(const Field& field, Plan plan, int rounds, Guide* guide) {
  return Planner(field, std::move(plan), guide).settle(rounds);
}

}  // namespace external_command
