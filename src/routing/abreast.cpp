// SPDX-License-Identifier: Apache-2.0
#include "abreast.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kAbreast = 1.0;      // [m] by which two pairings may disagree where one continues the other
constexpr double kSamePlace = 0.001;  // [m]

}  // namespace

double abreastUntil(const LaneGraph& graph, const BlockedLanes& blocked, const LanePoint& old_place,
                    const LaneGraph::Neighbour& neighbour, double new_s) {
  const LanePair& pair = neighbour.pair;
  if (std::abs(pair.toB(old_place.s) - new_s) > kAbreast) return new_s;
  if (blocked.contains(old_place.lane, old_place.s) || blocked.contains(pair.b, new_s)) return new_s;
  for (const Interval& part : graph.crossableParts(neighbour)) {
    if (old_place.s < part.from - kSamePlace || old_place.s > part.to) continue;
    const double old_to = blocked.freeUntil(old_place.lane, old_place.s, part.to);
    return std::max(new_s, blocked.freeUntil(pair.b, new_s, pair.toB(old_to)));
  }
  return new_s;
}

}  // namespace external_command
