// SPDX-License-Identifier: Apache-2.0
#include "corner.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace external_command {

namespace {

constexpr int kPlaces = 8;        ///< tried on each side
constexpr double kReach = 3.5;    ///< of the search along a side, in turning radii
constexpr int kSlantPlaces = 14;  ///< the same where it slants
constexpr double kSlantReach = 8.0;
constexpr double kDetour = 1.5;    ///< a curve this much longer than its chord is a loop
constexpr double kOwnPrice = 1.3;  ///< of what another lap or swath can still sweep: its length, and a little more
constexpr int kSwings = 5;         ///< distances from an edge tried
/// Where to pass a corner of the border, as share of the way from its tip to where the shortest arc would pass.
constexpr std::array<double, 4> kWider = {0.25, 0.45, 0.65, 0.85};
/// The same beyond that arc: room for the nose to swing out.
constexpr std::array<double, 6> kNarrower = {1.1, 1.25, 1.4, 1.6, 1.8, 2.1};

}  // namespace

CornerSearch::CornerSearch(const Field& field, CoverageGrid* grid, double price, bool slants)
    : field_(field),
      grid_(*grid),
      price_(price),
      slants_(slants),
      own_share_(std::min(1.0, kOwnPrice / field.width() / price)) {}

std::optional<CornerWay> CornerSearch::find(const Side& before, const Corner& corner, const Side& after) {
  best_.reset();
  const double reach = (slants_ ? kSlantReach : kReach) * field_.radius();
  const double skipped = std::max(0.0, before.length - reach);
  before_ = {partOf(before.curve, skipped, before.length), before.length - skipped};
  after_.length = std::min(after.length, reach);
  after_.curve = partOf(after.curve, 0.0, after_.length);
  leaves_ = places(before_, true);
  enters_ = places(after_, false);
  tryDirect();
  trySwing(corner);
  if (best_) best_->leave += skipped;
  return best_;
}

/// Places on a side, denser towards the corner.
std::vector<CornerSearch::Place> CornerSearch::places(const Side& side, bool at_end) const {
  std::vector<Place> result;
  const int places = slants_ ? kSlantPlaces : kPlaces;
  for (int i = 0; i < places; ++i) {
    const double share = static_cast<double>(i) / (places - 1);
    const double away = side.length * share * (0.4 + 0.6 * share);
    const double s = at_end ? side.length - away : away;
    result.push_back({s, poseAt(side.curve, s)});
  }
  return result;
}

void CornerSearch::tryDirect() {
  for (const Place& leave : leaves_) {
    for (const Place& enter : enters_) {
      const Curve curve{leave.pose, shortestDubins(leave.pose, enter.pose, field_.radius())};
      const double chord = (enter.pose.position() - leave.pose.position()).norm();
      if (curve.length() < kDetour * chord + field_.radius()) tryCurve(leave.s, enter.s, curve);
    }
  }
}

void CornerSearch::trySwing(const Corner& corner) {
  for (const Pose2d& apex : apexes(corner)) tryThrough(apex);
}

/// Round an edge: from as near as the vehicle fits outwards. Into a corner: between its tip and the shortest arc.
std::vector<Pose2d> CornerSearch::apexes(const Corner& corner) const {
  std::vector<Pose2d> poses;
  const Point2d left(-std::sin(corner.middle.heading), std::cos(corner.middle.heading));
  const auto add = [&](double shift) {
    const Pose2d pose{corner.middle.x + shift * left.x(), corner.middle.y + shift * left.y(), corner.middle.heading};
    if (field_.isFree(pose)) poses.push_back(pose);
  };
  if (corner.turn > 0.0) {
    const double half = std::min(corner.turn / 2.0, 1.2);
    const double whole = field_.radius() * (1.0 / std::cos(half) - 1.0);
    for (const double share : kWider) add(share * whole);
    if (!slants_) return poses;
    for (const double share : kNarrower) add(share * whole);
    return poses;
  }
  const double step = 0.05 * field_.radius();
  for (double shift = -field_.width() / 2.0; shift < 2.0 * field_.radius() && poses.size() < kSwings; shift += step) {
    add(shift);
  }
  return poses;
}

/// The best way to the apex and the best way on from there, each for itself.
void CornerSearch::tryThrough(const Pose2d& apex) {
  double best_first = 1e18, best_second = 1e18;
  Curve first, second;
  double leave = 0.0, enter = 0.0;
  const auto isLoop = [&](const Curve& curve) {
    return curve.length() > kDetour * (curve.end().position() - curve.start.position()).norm();
  };
  for (const Place& place : leaves_) {
    const Curve curve{place.pose, shortestDubins(place.pose, apex, field_.radius())};
    if (isLoop(curve) || !field_.isFree(curve)) continue;
    const double cost = costOf({partOf(before_.curve, 0.0, place.s), curve});
    if (cost < best_first) best_first = cost, first = curve, leave = place.s;
  }
  for (const Place& place : enters_) {
    const Curve curve{apex, shortestDubins(apex, place.pose, field_.radius())};
    if (isLoop(curve) || !field_.isFree(curve)) continue;
    const double cost = costOf({curve, partOf(after_.curve, place.s, after_.length)});
    if (cost < best_second) best_second = cost, second = curve, enter = place.s;
  }
  if (first.arcs.empty() || second.arcs.empty()) return;
  first.append(second.arcs);
  tryCurve(leave, enter, first);
}

void CornerSearch::tryCurve(double leave, double enter, const Curve& curve) {
  if (!field_.isFree(curve)) return;
  const Curve first = partOf(before_.curve, 0.0, leave);
  for (const bool fills : {false, true}) {
    if (fills && enter < 1e-3) continue;
    CornerWay way{leave, enter, curve, fills, 0.0};
    way.cost = costOf({first, curve, partOf(after_.curve, fills ? 0.0 : enter, after_.length)});
    if (fills) way.cost += enter + 2.0 * field_.gearPrice();
    if (!best_ || way.cost < best_->cost) best_ = way;
  }
}

double CornerSearch::costOf(const std::vector<Curve>& curves) {
  double length = 0.0;
  for (const Curve& curve : curves) length += curve.length();
  return length - price_ * grid_.gain(curves, field_.width(), own_share_);
}

}  // namespace external_command
