// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/core/pose.h"
#include "motion/footprint_index.h"
#include "motion/steering_words.h"

namespace external_command {

using Arcs = std::vector<ArcSegment>;

/// What every stage of the planning needs to know, in the local frame. Refers to the index.
struct Scene {
  const FootprintIndex& index;
  double radius;  ///< smallest turning radius [m]
  CostModel cost;
};

/// From where to where.
struct Query {
  Pose2d start;
  Pose2d goal;
  Junctions junctions = {};  ///< gear 0: the vehicle stands at the start, or stops at the goal
};

inline int gearOf(const ArcSegment& arc) { return arc.length < 0.0 ? -1 : 1; }

/// Cost of the arcs with gear changes and steering between them and at the junctions.
double costOf(const Arcs& arcs, const CostModel& cost, const Junctions& junctions = {});

/// Of going over from a path that arrives so to the arcs, and of going on from them.
double costBefore(const Arcs& arcs, const CostModel& cost, const Junctions& junctions);
double costAfter(const Arcs& arcs, const CostModel& cost, const Junctions& junctions);

double lengthOf(const Arcs& arcs);
unsigned gearChangesOf(const Arcs& arcs);

/// Changes of curvature between gear changes, as multiples of that from straight on to full lock.
double wheelTurnsOf(const Arcs& arcs, double radius);

/// The same curve, driven from its end to its begin.
Arcs reversed(const Arcs& arcs);

/// Neighbours of the same curvature and gear joined, empty arcs dropped.
Arcs merged(const Arcs& arcs);

void append(const SteeringWord& word, Arcs* arcs);

/// Whether the curve from `from` is free at steps in which no corner moves more than `step` [m]. Ends and middles of
/// the arcs are looked at first: most curves that collide do so there. `from` itself is not checked.
bool isFree(const FootprintIndex& index, const Pose2d& from, const SteeringWord& word, double step);

/// Whether the curve keeps the margin everywhere; see FootprintIndex::keepsMargin.
bool keepsMargin(const FootprintIndex& index, const Pose2d& from, const SteeringWord& word);

}  // namespace external_command
