// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bypass.h"
#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "coverage/field/profile.h"
#include "stretches.h"
#include "swaths.h"

namespace external_command {

/// Looks for the stretches that are worth a swath on parallel lines, a swath's pitch apart.
class LineSearch {
 public:
  /// @param grid    tells where the vehicle can be; kept by reference.
  /// @param swaths  that a line stands for; more than one for a coarse look.
  LineSearch(const Field& field, const SwathPrices& prices, const CoverageGrid& grid, double swaths = 1.0)
      : field_(field), turn_(swaths * prices.turn), unswept_(prices.unswept), swaths_(swaths), bypasses_(field, grid) {}

  /// Searches each line, and hands it over with its distance across.
  /// @param bins    of the profile across a line.
  /// @param offset  of the first line from the first possible one [bins].
  template <class Visit>
  void visitLines(const Profile& profile, int bins, int offset, const Visit& visit) const {
    StretchSearch search(turn_, swaths_ * profile.bin());
    const double pitch = swaths_ * (field_.width() - field_.params().overlap) / profile.bin();
    for (double first = -offset; first < profile.rows(); first += pitch) {
      field_.poll();
      const int row = static_cast<int>(std::lround(first));
      const double across = first * profile.bin() + swaths_ * field_.width() / 2.0;
      if (unswept_ * profile.areaOf(row, row + bins) <= turn_) continue;
      const float *low = profile.below(row), *high = profile.below(row + bins);
      int passed = 0;
      const double worth = search.best(
          profile.columns(), [&](int i) { return unswept_ * static_cast<double>(high[i] - low[i]); },
          [&](int i, bool begins) { return toll(profile, across, i, begins, &passed); });
      visit(across, worth, search);
    }
  }

  /// Of all lines [m].
  double worthOf(const Profile& profile, int bins, int offset) const {
    double sum = 0.0;
    visitLines(profile, bins, offset, [&](double, double worth, const StretchSearch&) { sum += worth; });
    return sum;
  }

 private:
  /// Of what blocks the line at a column, all of it at the first one: what it takes to pass, less what it would take
  /// more than another beginning to end before it and go on behind it, where there is no headland to turn on.
  /// @param passed  one past the last column that was paid for.
  double toll(const Profile& profile, double across, int column, bool begins, int* passed) const {
    constexpr double kNoWay = std::numeric_limits<double>::infinity();
    if (bypasses_.isOpen(profile, across, column)) return 0.0;
    if (begins) return kNoWay;
    if (column < *passed) return 0.0;
    const std::optional<Bypass> bypass = bypasses_.find(profile, across, column);
    if (!bypass) return kNoWay;
    *passed = bypass->end;
    const double beyond_blocked = field_.vehicle().length() - field_.vehicle().width;
    const double more_left = bypass->left - beyond_blocked * field_.width();
    return swaths_ * std::max(0.0, bypass->more + unswept_ * std::max(0.0, more_left) - 2.0 * field_.gearPrice());
  }

  const Field& field_;
  double turn_;     ///< price [m]
  double unswept_;  ///< price [m/m^2]
  double swaths_;
  BypassSearch bypasses_;
};

}  // namespace external_command
