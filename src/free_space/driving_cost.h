// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "manoeuvre.h"

namespace external_command {

/// What driving near an obstacle costs.
struct ClosenessPrice {
  double price;     ///< of a metre at the margin, as length forward; nothing at the distance and beyond it
  double distance;  ///< beyond the margin [m]
};

/// What a path costs a driver, as length forward [m]: metres forward and in reverse, gear changes, turning the wheels
/// between them, and driving near obstacles. The search knows metres and gear changes only; see Scene::cost.
class DrivingCost {
 public:
  /// @param steering_cost  of turning the wheels from straight on to full lock [m].
  DrivingCost(const Scene& scene, double steering_cost, const ClosenessPrice& closeness);

  /// All but closeness: what can be told from the arcs alone.
  const CostModel& ofArcs() const { return of_arcs_; }

  /// What the obstacles beside a curve from `from` add.
  double ofCloseness(const Pose2d& from, const ArcSegment& arc) const;
  double ofCloseness(const Pose2d& from, const SteeringWord& word) const;

  /// Of the whole path.
  double of(const Pose2d& from, const Arcs& arcs, const Junctions& junctions) const;

  /// Length of a path beside obstacles: all of it where they are at the margin, less where they are farther [m].
  double nearLength(const Pose2d& from, const Arcs& arcs) const;

 private:
  double nearLength(const Pose2d& from, const ArcSegment* begin, const ArcSegment* end) const;
  double closenessAt(const Frame& frame) const;

  const FootprintIndex& index_;
  CostModel of_arcs_;
  ClosenessPrice closeness_;
  double at_margin_;  ///< distance of the footprint's middle from what is at the margin beside the vehicle [m]
};

}  // namespace external_command
