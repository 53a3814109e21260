// SPDX-License-Identifier: Apache-2.0
#include "driving_cost.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kStep = 0.4;  ///< between two looks at the obstacles, at most [m]

CostModel withSteering(CostModel cost, double price) {
  cost.steering_price = price;
  return cost;
}

}  // namespace

DrivingCost::DrivingCost(const Scene& scene, double steering_cost, const ClosenessPrice& closeness)
    : index_(scene.index),
      of_arcs_(withSteering(scene.cost, steering_cost * scene.radius)),
      closeness_(closeness),
      at_margin_(scene.index.box().half_width + scene.index.margin()) {}

double DrivingCost::ofCloseness(const Pose2d& from, const ArcSegment& arc) const {
  return closeness_.price > 0.0 ? closeness_.price * nearLength(from, &arc, &arc + 1) : 0.0;
}

double DrivingCost::ofCloseness(const Pose2d& from, const SteeringWord& word) const {
  const ArcSegment* const arcs = word.arcs.data();
  return closeness_.price > 0.0 ? closeness_.price * nearLength(from, arcs, arcs + word.size) : 0.0;
}

double DrivingCost::of(const Pose2d& from, const Arcs& arcs, const Junctions& junctions) const {
  return costOf(arcs, of_arcs_, junctions) + closeness_.price * nearLength(from, arcs);
}

double DrivingCost::nearLength(const Pose2d& from, const Arcs& arcs) const {
  return nearLength(from, arcs.data(), arcs.data() + arcs.size());
}

double DrivingCost::nearLength(const Pose2d& from, const ArcSegment* begin, const ArcSegment* end) const {
  double sum = 0.0;
  Frame frame(from);
  for (const ArcSegment* arc = begin; arc != end; ++arc) {
    const int steps = static_cast<int>(std::ceil(std::abs(arc->length) / kStep));
    if (steps == 0) continue;
    const double step = arc->length / steps;
    const Stride half(arc->kappa, 0.5 * step);  // the room is looked at in the middle of each step
    for (int i = 0; i < steps; ++i) {
      frame.drive(half);
      sum += closenessAt(frame) * std::abs(step);
      frame.drive(half);
    }
  }
  return sum;
}

/// From 1 at the margin, or nearer, to 0: of what is beside the vehicle. What is ahead of it, it comes to on purpose.
double DrivingCost::closenessAt(const Frame& frame) const {
  const double ahead = index_.box().centre;
  const Point2d middle(frame.x + ahead * frame.cos, frame.y + ahead * frame.sin);
  return std::clamp(1.0 - (index_.roomBetweenCells(middle) - at_margin_) / closeness_.distance, 0.0, 1.0);
}

}  // namespace external_command
