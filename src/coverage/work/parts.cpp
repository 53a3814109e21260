// SPDX-License-Identifier: Apache-2.0
#include "parts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "line_search.h"

namespace external_command {

namespace {

constexpr int kBins = 2;              ///< across a swath
constexpr double kFine = 600.0;       ///< squares of a swath's width beyond which one bin has to do
constexpr double kBlock = 0.6;        ///< side of the squares that what is left is seen in [bins]
constexpr std::size_t kHeadings = 5;  ///< tried in each part
constexpr double kDistinct = 0.12;    ///< between two of these [rad]
constexpr int kCuts = 6;              ///< tried across a part, before the best is moved line by line
constexpr int kMostDivisions = 5;     ///< one within another
constexpr double kLeast = 12.0;       ///< of a part, in squares of a swath's width
constexpr double kTurnsGained = 1.5;  ///< by a division, at least

class Divider {
 public:
  Divider(const Field& field, const SwathPrices& prices, const CoverageGrid& grid)
      : field_(field),
        prices_(prices),
        search_(field, prices, grid),
        least_(kLeast * field.width() * field.width()),
        bins_(grid.area(kGoal, kSwept) < kFine * field.width() * field.width() ? kBins : 1),
        bin_(field.width() / bins_),
        all_(grid, kBlock * bin_) {}

  std::vector<Part> run() {
    chooseHeadings();
    if (headings_.size() < 2) return {Part{}};
    divide(all_, {}, bestWorth(all_), kMostDivisions);
    return std::move(parts_);
  }

 private:
  /// A line between two swaths.
  struct Cut {
    Point2d aside;       ///< across the swaths
    double at = 0.0;     ///< along `aside` [m]
    double below = 0.0;  ///< worth of the swaths on its lower side
    double above = 0.0;  ///< and on the other
  };

  struct Division {
    Part low, high;
    double low_worth = 0.0, high_worth = 0.0;

    double worth() const { return low_worth + high_worth; }
  };

  double worthOf(const Remains& remains, double heading) const {
    return search_.worthOf(Profile(remains, heading, bin_), bins_, 0);
  }

  double bestWorth(const Remains& remains) const {
    double best = 0.0;
    for (const double heading : headings_) best = std::max(best, worthOf(remains, heading));
    return best;
  }

  /// The best ones for the whole, unlike each other: a part's best direction is seldom bad for all the rest.
  void chooseHeadings() {
    std::vector<SwathHeading> ranked;
    for (const double heading : swathHeadings(field_)) {
      field_.poll();
      ranked.push_back({heading, worthOf(all_, heading)});
    }
    const auto better = [](const SwathHeading& a, const SwathHeading& b) { return a.worth > b.worth; };
    std::stable_sort(ranked.begin(), ranked.end(), better);
    for (const SwathHeading& entry : ranked) {
      const auto isNear = [&](double other) {
        return std::abs(std::remainder(other - entry.heading, M_PI)) < kDistinct;
      };
      if (headings_.size() == kHeadings) break;
      if (std::none_of(headings_.begin(), headings_.end(), isNear)) headings_.push_back(entry.heading);
    }
  }

  void divide(const Remains& remains, const Part& part, double worth, int divisions) {
    std::optional<Division> best;
    if (divisions > 0 && remains.area > 2.0 * least_) best = bestDivision(remains, worth);
    if (!best) {
      parts_.push_back(part);
      return;
    }
    const auto go = [&](const Part& side, double side_worth) {
      Part inner = part;
      inner.insert(inner.end(), side.begin(), side.end());
      divide(remains.within(side), inner, side_worth, divisions - 1);
    };
    go(best->low, best->low_worth);
    go(best->high, best->high_worth);
  }

  std::optional<Division> bestDivision(const Remains& remains, double worth) const {
    std::optional<Division> best;
    double most = worth + kTurnsGained * prices_.turn;
    for (const double heading : headings_) {
      const std::vector<Cut> cuts = cutsAlong(remains, heading);
      const int n = static_cast<int>(cuts.size()), stride = std::max(1, n / kCuts);
      int pick = -1;
      const auto consider = [&](int i) {
        if (i < 0 || i >= n) return;
        field_.poll();
        const Division division = divisionBy(cuts[static_cast<std::size_t>(i)], remains);
        if (division.worth() > most) most = division.worth(), best = division, pick = i;
      };
      for (int i = stride / 2; i < n; i += stride) consider(i);
      for (int step = stride / 2; step > 0 && pick >= 0; step /= 2) {
        const int middle = pick;
        consider(middle - step);
        consider(middle + step);
      }
    }
    return best;
  }

  /// Beyond each line of swaths but the last.
  std::vector<Cut> cutsAlong(const Remains& remains, double heading) const {
    const Profile profile(remains, heading, bin_);
    const Point2d aside(-std::sin(heading), std::cos(heading));
    std::vector<Cut> cuts;
    double sum = 0.0;
    search_.visitLines(profile, bins_, 0, [&](double across, double worth, const StretchSearch&) {
      sum += worth;
      cuts.push_back({aside, profile.point(0.0, across + field_.width() / 2.0).dot(aside), sum, 0.0});
    });
    for (Cut& cut : cuts) cut.above = sum - cut.below;
    if (!cuts.empty()) cuts.pop_back();
    return cuts;
  }

  /// Worth nothing where a side is too small.
  Division divisionBy(const Cut& cut, const Remains& remains) const {
    Division division{{{-cut.aside, -cut.at}}, {{cut.aside, cut.at}}, 0.0, 0.0};
    const Remains low = remains.within(division.low), high = remains.within(division.high);
    if (std::min(low.area, high.area) < least_) return division;
    division.low_worth = std::max(cut.below, bestWorth(low));
    division.high_worth = std::max(cut.above, bestWorth(high));
    return division;
  }

  const Field& field_;
  SwathPrices prices_;
  LineSearch search_;
  double least_;  ///< area of a part [m^2]
  int bins_;      ///< across a swath
  double bin_;    ///< [m]
  Remains all_;
  std::vector<double> headings_;
  std::vector<Part> parts_;
};

}  // namespace

std::vector<Part> divided(const Field& field, const SwathPrices& prices, const CoverageGrid& grid) {
  return Divider(field, prices, grid).run();
}

}  // namespace external_command
