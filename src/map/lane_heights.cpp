// SPDX-License-Identifier: Apache-2.0
#include "lane_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace external_command {

namespace {

constexpr double kHeightTolerance = 0.1;  // [m]

/// The slopes of lines from one sample that pass those seen since within the tolerance.
struct Slopes {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  /// @return false where no line passes `to` as well.
  bool narrow(const HeightSample& from, const HeightSample& to) {
    const double run = std::max(to.s - from.s, 1e-3), rise = to.z - from.z;
    if (rise / run < least || rise / run > most) return false;
    least = std::max(least, (rise - kHeightTolerance) / run);
    most = std::min(most, (rise + kHeightTolerance) / run);
    return true;
  }
};

}  // namespace

std::vector<HeightSample> heightProfile(const std::vector<Point2d>& line, const std::vector<float>& heights) {
  if (heights.empty() || heights.size() != line.size()) return {};
  if (!std::all_of(heights.begin(), heights.end(), [](float z) { return std::isfinite(z); })) return {};
  std::vector<HeightSample> profile = {{0.0, static_cast<double>(heights.front())}};
  HeightSample last = profile.front();
  Slopes slopes;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const HeightSample next{last.s + (line[i] - line[i - 1]).norm(), static_cast<double>(heights[i])};
    if (!slopes.narrow(profile.back(), next)) {
      profile.push_back(last);
      slopes = {};
      slopes.narrow(profile.back(), next);
    }
    last = next;
  }
  profile.push_back(last);
  return profile;
}

}  // namespace external_command
