// SPDX-License-Identifier: Apache-2.0
#include "blocked_lanes.h"

#include <algorithm>

namespace external_command {

namespace {

constexpr double kMargin = 0.001;  // [m]

}  // namespace

BlockedLanes::BlockedLanes(const std::vector<LaneRange>& ranges) : ranges_(ranges) {
  for (LaneRange& range : ranges_) {
    range.from_s -= kMargin;
    range.to_s += kMargin;
  }
  std::sort(ranges_.begin(), ranges_.end(), [](const LaneRange& a, const LaneRange& b) {
    return a.lane != b.lane ? a.lane < b.lane : a.from_s < b.from_s;
  });
}

std::vector<LaneRange>::const_iterator BlockedLanes::firstOf(LaneIndex lane) const {
  return std::lower_bound(ranges_.begin(), ranges_.end(), lane,
                          [](const LaneRange& range, LaneIndex index) { return range.lane < index; });
}

bool BlockedLanes::contains(LaneIndex lane, double s) const {
  if (ranges_.empty()) return false;
  for (auto range = firstOf(lane); range != ranges_.end() && range->lane == lane; ++range) {
    if (s > range->from_s && s < range->to_s) return true;
  }
  return false;
}

double BlockedLanes::freeUntil(LaneIndex lane, double s, double end) const {
  if (ranges_.empty()) return end;
  for (auto range = firstOf(lane); range != ranges_.end() && range->lane == lane; ++range) {
    if (range->from_s >= s) return std::min(end, range->from_s);
  }
  return end;
}

std::vector<Interval> BlockedLanes::freeParts(LaneIndex lane, double from, double to) const {
  std::vector<Interval> parts;
  for (auto range = firstOf(lane); range != ranges_.end() && range->lane == lane; ++range) {
    if (range->to_s < from) continue;
    if (range->from_s > to) break;
    if (range->from_s > from) parts.push_back({from, range->from_s});
    from = std::max(from, range->to_s);
  }
  if (from < to) parts.push_back({from, to});
  return parts;
}

}  // namespace external_command
