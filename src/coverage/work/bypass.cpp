// SPDX-License-Identifier: Apache-2.0
#include "bypass.h"

#include <algorithm>
#include <cmath>

#include "coverage/path/side_step.h"

namespace external_command {

namespace {

constexpr double kMostBlocked = 3.0;  ///< along a line, besides the vehicle's width [turning radii]

}  // namespace

std::optional<Bypass> BypassSearch::find(const Profile& profile, double across, int column) const {
  const double most = kMostBlocked * field_.radius() + field_.vehicle().width;
  Bypass bypass;
  for (bypass.end = column; !isOpen(profile, across, bypass.end); ++bypass.end) {
    if ((bypass.end - column) * profile.bin() > most || !is(kPassable, profile, across, bypass.end))
      return std::nullopt;
  }
  const std::optional<double> shift = shiftPast(profile, across, column, bypass.end);
  if (!shift) return std::nullopt;
  const SideStep bend(*shift, field_.radius());
  bypass.shift = *shift;
  bypass.more = 2.0 * bend.more;
  bypass.left = areaLeft(profile, across, bypass, column, bend.along);
  return bypass;
}

/// The smallest one to either side.
std::optional<double> BypassSearch::shiftPast(const Profile& profile, double across, int begin, int end) const {
  const int steps = static_cast<int>(field_.mostShift() / grid_.cell());
  for (int i = 1; i <= steps; ++i) {
    for (const double side : {1.0, -1.0}) {
      const double shift = side * i * grid_.cell();
      int column = begin;
      while (column < end && isOpen(profile, across + shift, column)) ++column;
      if (column == end) return shift;
    }
  }
  return std::nullopt;
}

/// Of the edge of the swath that it shifts away from; along the bends, half of that.
double BypassSearch::areaLeft(const Profile& profile, double across, const Bypass& bypass, int begin,
                              double bend) const {
  const double reach = field_.front() + bend / 2.0 - field_.vehicle().width / 2.0, bin = profile.bin();
  const int first = std::max(0, static_cast<int>(begin - reach / bin));
  const int last = std::min(profile.columns(), static_cast<int>(bypass.end + bend / 2.0 / bin));
  const double edge = across - std::copysign(field_.width() / 2.0, bypass.shift);
  const double low = std::min(edge, edge + bypass.shift) / bin, high = std::max(edge, edge + bypass.shift) / bin;
  const float *below = profile.below(static_cast<int>(std::lround(low))),
              *above = profile.below(static_cast<int>(std::lround(high)));
  double area = 0.0;
  for (int i = first; i < last; ++i) area += static_cast<double>(above[i] - below[i]);
  return area;
}

}  // namespace external_command
