// SPDX-License-Identifier: Apache-2.0
#include "corner.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr int kSteps = 9;          ///< places tried on each side
constexpr double kReach = 3.5;     ///< of the search along a side, in turning radii
constexpr double kDetour = 1.5;    ///< a curve this much longer than its chord, and a turn, is a loop
constexpr int kSwings = 5;         ///< distances from the edge tried

/// Place `i` of kSteps within `reach`, denser near 0.
double placeAt(int i, double reach) {
  const double share = static_cast<double>(i) / (kSteps - 1);
  return reach * share * (0.4 + 0.6 * share);
}

}  // namespace

std::optional<CornerWay> CornerSearch::find(const Side& before, const Corner& corner, const Side& after) {
  best_.reset();
  first_reach_ = std::min(before.length, kReach * field_.radius());
  second_reach_ = std::min(after.length, kReach * field_.radius());
  tryDirect(before, after);
  if (corner.turn < 0.0) trySwing(before, corner, after);
  return best_;
}

void CornerSearch::tryDirect(const Side& before, const Side& after) {
  for (int i = 0; i < kSteps; ++i) {
    const double leave = before.length - placeAt(i, first_reach_);
    const Pose2d from = poseAt(before.curve, leave);
    for (int j = 0; j < kSteps; ++j) {
      const double enter = placeAt(j, second_reach_);
      const Curve curve{from, shortestDubins(from, poseAt(after.curve, enter), field_.radius())};
      tryCurve(before, after, leave, enter, curve);
    }
  }
}

std::vector<Pose2d> CornerSearch::apexes(const Corner& corner) const {
  std::vector<Pose2d> poses;
  const Point2d out(-std::sin(corner.middle.heading), std::cos(corner.middle.heading));
  const double nearest = -field_.width() / 2.0, step = 0.05 * field_.radius();
  for (double shift = nearest; shift < 2.0 * field_.radius() && poses.size() < kSwings; shift += step) {
    const Pose2d pose{corner.middle.x + shift * out.x(), corner.middle.y + shift * out.y(), corner.middle.heading};
    if (field_.isFree(pose)) poses.push_back(pose);
  }
  return poses;
}

void CornerSearch::trySwing(const Side& before, const Corner& corner, const Side& after) {
  for (const Pose2d& apex : apexes(corner)) {
    for (int i = 0; i < kSteps; ++i) {
      const double leave = before.length - placeAt(i, first_reach_);
      Curve first{poseAt(before.curve, leave), {}};
      first.append(shortestDubins(first.start, apex, field_.radius()));
      const double chord = (apex.position() - first.start.position()).norm();
      if (first.length() > kDetour * chord || !field_.isFree(first)) continue;
      for (int j = 0; j < kSteps; ++j) {
        const double enter = placeAt(j, second_reach_);
        Curve whole = first;
        whole.append(shortestDubins(apex, poseAt(after.curve, enter), field_.radius()));
        tryCurve(before, after, leave, enter, whole);
      }
    }
  }
}

void CornerSearch::tryCurve(const Side& before, const Side& after, double leave, double enter, const Curve& curve) {
  const double chord = (poseAt(after.curve, enter).position() - curve.start.position()).norm();
  if (curve.length() > kDetour * chord + M_PI * field_.radius() || !field_.isFree(curve)) return;
  for (const bool fills : {false, true}) {
    if (fills && enter < 1e-3) continue;
    CornerWay way{leave, enter, curve, fills, 0.0};
    way.cost = costOf(before, after, way);
    if (!best_ || way.cost < best_->cost) best_ = way;
  }
}

double CornerSearch::costOf(const Side& before, const Side& after, const CornerWay& way) {
  const Curve first = partOf(before.curve, before.length - first_reach_, way.leave);
  const Curve second = partOf(after.curve, way.fills ? 0.0 : way.enter, second_reach_);
  double length = first.length() + way.curve.length() + second.length();
  if (way.fills) length += way.enter + 2.0 * field_.params().gear_change_cost;
  return length - price_ * grid_.gain({first, way.curve, second}, field_.width(), kInner);
}

}  // namespace external_command
