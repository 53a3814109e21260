// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "external_command/coverage/coverage_progress.h"

namespace external_command {

/// A lap round a yard of 40 m x 30 m, and two swaths in it, 20 m each.
inline CoverageProgress lapAndSwaths() {
  CoverageProgress progress;
  SwathLine lap{{8.0, 3.0, 0.0}, {}, 0};
  for (const double side : {24.0, 14.0, 24.0, 14.0}) {
    lap.arcs.push_back({side, 0.0});
    lap.arcs.push_back({5.0 * M_PI / 2.0, 0.2});
  }
  progress.lines = {lap, {{10.0, 12.0, 0.0}, {{20.0, 0.0}}, -1}, {{30.0, 14.0, M_PI}, {{20.0, 0.0}}, -1}};
  return progress;
}

/// Half of the lap is swept, and the first swath was blocked.
inline CoverageProgress begunPlan() {
  CoverageProgress progress = lapAndSwaths();
  progress.sweep(0, 123.0 / 2.7);
  progress.skipped = {1};
  return progress;
}

inline bool areEqual(const SwathLine& a, const SwathLine& b) {
  const auto isSame = [](const ArcSegment& c, const ArcSegment& d) {
    return c.length == d.length && c.kappa == d.kappa;
  };
  return a.start.x == b.start.x && a.start.y == b.start.y && a.start.heading == b.start.heading && a.lap == b.lap &&
         std::equal(a.arcs.begin(), a.arcs.end(), b.arcs.begin(), b.arcs.end(), isSame);
}

inline bool areEqual(const CoverageProgress& a, const CoverageProgress& b) {
  const auto isSame = [](const SwathLine& c, const SwathLine& d) { return areEqual(c, d); };
  return std::equal(a.lines.begin(), a.lines.end(), b.lines.begin(), b.lines.end(), isSame) && a.swept == b.swept &&
         a.skipped == b.skipped;
}

}  // namespace external_command
