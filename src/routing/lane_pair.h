// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "external_command/map/hd_map.h"
#include "external_command/routing/router.h"

namespace external_command {

/// A closed range of `s` on one lane [m].
struct Interval {
  double from = 0.0;
  double to = 0.0;
};

/// Lane `b` beside lane `a`: [a_from, a_to] lies abreast of [b_from, b_to], in proportion.
struct LanePair {
  LaneIndex b = 0;
  LaneChange side = LaneChange::kNone;  ///< where `b` lies, seen from `a`
  double a_from = 0.0, a_to = 0.0;      ///< on `a` [m]
  double b_from = 0.0, b_to = 0.0;      ///< on `b` [m]

  /// The position on `b` abreast of `s` on `a`, and back.
  double toB(double s) const { return b_from + (s - a_from) * (b_to - b_from) / (a_to - a_from); }
  double toA(double s) const { return a_from + (s - b_from) * (a_to - a_from) / (b_to - b_from); }
};

/// How two lanes that the map calls neighbours lie beside each other: in all their length where they begin and end
/// together, else where one's ends project onto the other.
/// @return nullopt where they do not lie side by side at all.
std::optional<LanePair> pairOf(const HdMap& map, LaneIndex a, LaneIndex b, LaneChange side);

/// Where a vehicle on `a` may cross to `b`: not over a solid or double line or a curb. The line as `a` states it
/// counts; where it says nothing, as `b` does; where neither does, or the line is virtual, it may be crossed.
/// @return ranges of `s` on `a`, rising, none shorter than 1 mm.
std::vector<Interval> crossableParts(const HdMap& map, LaneIndex a, const LanePair& pair);

}  // namespace external_command
