// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "plan.h"

namespace external_command {

namespace {

constexpr double kLowPrice = 120.0;   ///< of a whole area below kLowCoverage, in lengths of a perfect path
constexpr double kShortPrice = 16.0;  ///< the same below the target
constexpr double kExtraPrice = 1.0;   ///< the same beyond the target
constexpr double kLongPrice = 6.0;    ///< of length beyond what is usual for the size of the field

/// Length, as multiple of a perfect path's, that the last corners are not worth: a field of a few hundred swath widths
/// squared is mostly corners and turns.
double longFor(const Field& field, double goal) {
  constexpr double kSmall = 800.0, kSmallLong = 1.45, kLargeLong = 1.16;
  const double size = goal / (field.width() * field.width());
  return std::clamp(kSmallLong - (kSmallLong - kLargeLong) * std::log2(size / kSmall), kLargeLong, kSmallLong);
}

}  // namespace

double costOf(const Field& field, double effort, double length, double covered, double goal) {
  const double share = covered / goal, missing = field.params().target_coverage - share;
  const double perfect = std::max(covered, 1e-3) / field.width(), ratio = length / perfect;
  return effort / perfect + kLongPrice * std::max(0.0, ratio - longFor(field, goal)) +
         (missing > 0.0 ? kShortPrice : kExtraPrice) * missing + kLowPrice * std::max(0.0, kLowCoverage - share);
}

}  // namespace external_command
