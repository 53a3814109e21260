// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "coverage/field/profile.h"
#include "stretches.h"
#include "swaths.h"

namespace external_command {

/// Looks for the stretches that are worth a swath on parallel lines, a swath's pitch apart.
class LineSearch {
 public:
  /// @param grid  tells where the vehicle can be; kept by reference.
  LineSearch(const Field& field, const SwathPrices& prices, const CoverageGrid& grid)
      : field_(field), prices_(prices), grid_(grid) {}

  /// Searches each line, and hands it over with its distance across.
  /// @param bins    of the profile across a swath.
  /// @param offset  of the first line from the first possible one [bins].
  template <class Visit>
  void visitLines(const Profile& profile, int bins, int offset, const Visit& visit) const {
    StretchSearch search(prices_.turn, profile.bin());
    const double pitch = (field_.width() - field_.params().overlap) / profile.bin();
    for (double first = -offset; first < profile.rows(); first += pitch) {
      const int row = static_cast<int>(std::lround(first));
      const double across = first * profile.bin() + field_.width() / 2.0;
      if (prices_.unswept * profile.areaOf(row, row + bins) <= prices_.turn) continue;
      const float *low = profile.below(row), *high = profile.below(row + bins);
      const double worth = search.best(
          profile.columns(), [&](int i) { return prices_.unswept * static_cast<double>(high[i] - low[i]); },
          [&](int i) { return (grid_.at(profile.point((i + 0.5) * profile.bin(), across)) & kOpen) != 0; });
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
  const Field& field_;
  SwathPrices prices_;
  const CoverageGrid& grid_;
};

}  // namespace external_command
