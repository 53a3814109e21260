// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/routing/router.h"
#include "lane_pair.h"

namespace external_command {

/// The black list of one query, for fast look-up. Each range counts 1 mm wider than stated, so that a route never
/// touches its ends.
class BlockedLanes {
 public:
  explicit BlockedLanes(const std::vector<LaneRange>& ranges);

  bool empty() const { return ranges_.empty(); }

  bool contains(LaneIndex lane, double s) const;

  /// How far one can drive from `s`, which is not blocked, to at most `end` [m].
  double freeUntil(LaneIndex lane, double s, double end) const;

  /// What is free of [from, to], rising.
  std::vector<Interval> freeParts(LaneIndex lane, double from, double to) const;

 private:
  std::vector<LaneRange>::const_iterator firstOf(LaneIndex lane) const;

  std::vector<LaneRange> ranges_;  // by lane, then by from_s
};

}  // namespace external_command
