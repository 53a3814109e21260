// SPDX-License-Identifier: Apache-2.0
#include "links.h"

#include <algorithm>
#include <cmath>

#include "coverage/path/turns.h"

namespace external_command {

namespace {

constexpr double kDifference = 0.1;          ///< of a way's price from the guess that does not matter [m]
constexpr double kNear = 8.0;                ///< ends that a turn leads between, not a transfer [turning radii]
constexpr std::size_t kTurnsTried = 8;       ///< in the guess
constexpr double kChangesWithoutRoom = 2.0;  ///< of gear, more than the cheapest turn's, where none of them has room
constexpr double kLoop = 25.0;        ///< longer, at most, than the cheapest turn where none has room [turning radii]
constexpr double kMostExcess = 10.0;  ///< of a way over its guess: no way counts as that [turning radii]
constexpr double kRoomStep = 0.25;    ///< between places looked at [turning radii]

}  // namespace

Links::Links(const Field& field, const std::vector<Work>& works, Guide* guide)
    : field_(field), works_(works), guide_(*guide) {}

std::uint64_t Links::idOf(const Step* from, const Step* to) {
  const auto id = [](const Step* step) {
    return step == nullptr ? 0 : (static_cast<std::uint64_t>(step->work + 1) << 14U) + step->way;
  };
  return (id(from) << 32U) + id(to);
}

Links::Cost Links::costOf(const Step* from, const Step* to) {
  if (to == nullptr || (from == nullptr && !field_.start())) return {0.0F, 0.0F, false};
  const auto [entry, is_new] = known_.try_emplace(idOf(from, to), Cost{0.0F, 0.0F, true});
  if (is_new) entry->second = guess(beginOf(from), startOf(*to));
  return entry->second;
}

/// Whatever reverses takes two changes of gear at least, so that a way forward need not be compared with all ways.
Links::Cost Links::guess(const Pose2d& from, const Pose2d& to) {
  const auto costOf = [](double price, double length) {
    return Cost{static_cast<float>(price), static_cast<float>(length), true};
  };
  const double straight = (to.position() - from.position()).norm();
  const double detour = guide_.routes.distance(from.position(), to.position()) - straight;
  const double shortest = reedsSheppLength(from, to, field_.radius());
  const double reversing = shortest + 2.0 * field_.gearPrice();
  const std::vector<SteeringCurve> forward = dubinsCurves(from, to, field_.radius());
  if (detour >= kDifference || straight >= kNear * field_.radius()) {
    const double ahead = forward.front().length;
    return ahead <= reversing ? costOf(ahead + detour, ahead + detour) : costOf(reversing + detour, shortest + detour);
  }
  for (const SteeringCurve& turn : forward) {
    if (turn.length > reversing) break;
    if (hasRoom(from, turn)) return costOf(turn.length, turn.length);
  }
  const std::vector<SteeringCurve> turns = turnsWithoutObstacles(from, to, field_.radius(), field_.gearPrice());
  for (std::size_t i = 0; i < std::min(kTurnsTried, turns.size()); ++i) {
    if (hasRoom(from, turns[i])) return costOf(turns[i].cost, turns[i].length);
  }
  const double more =
      field_.radius() * std::min(kLoop, 1.0 + kChangesWithoutRoom * field_.gearPrice() / field_.radius());
  return costOf(turns.front().cost + more, turns.front().length + more);
}

/// Looks at points along the middle of the vehicle.
bool Links::hasRoom(const Pose2d& from, const SteeringCurve& turn) const {
  const double half = field_.vehicle().width / 2.0;
  const double nose = field_.front() - half, tail = half - field_.vehicle().rear_overhang;
  Pose2d begin = from;
  for (const ArcSegment& arc : turn.arcs) {
    const double length = std::abs(arc.length);
    const int n = static_cast<int>(length / (kRoomStep * field_.radius())) + 1;
    for (int i = 1; i <= n; ++i) {
      const Pose2d pose = advance(begin, arc, length * i / n);
      const Point2d ahead = unitVector(pose.heading);
      if (!guide_.routes.isOpen(pose.position() + (arc.length > 0.0 ? nose : tail) * ahead)) return false;
    }
    begin = advance(begin, arc);
  }
  return true;
}

bool Links::settle(const Step* from, const Step* to) {
  if (to == nullptr || (from == nullptr && !field_.start())) return false;
  const auto [entry, is_new] = ways_.try_emplace(idOf(from, to));
  if (!is_new) return false;
  const std::optional<Curve> driven = from == nullptr ? std::nullopt : std::optional<Curve>(curveOf(*from));
  std::optional<Curve>& way = entry->second;
  way = guide_.connector.connect(driven ? &*driven : nullptr, beginOf(from), curveOf(*to));
  const double guessed = static_cast<double>(costOf(from, to).price), length = way ? way->length() : kNoWay;
  const double found = length + (way ? field_.gearPrice() * way->gearChangesBetween() : 0.0);
  known_[idOf(from, to)] = {static_cast<float>(found), static_cast<float>(length), false};
  excess_ += std::min(found - guessed, kMostExcess * field_.radius());
  ++excesses_;
  return std::abs(found - guessed) > kDifference;
}

void Links::doubtGuesses() {
  if (excesses_ == 0) return;
  doubt_ = std::max(0.0, excess_ / static_cast<double>(excesses_));
  excess_ = 0.0;
  excesses_ = 0;
}

std::optional<Curve> Links::way(const Step* from, const Step* to) const {
  const auto known = ways_.find(idOf(from, to));
  return known == ways_.end() ? std::nullopt : known->second;
}

double Links::bound(const Step* from, const Step* to) const {
  if (to == nullptr || (from == nullptr && !field_.start())) return 0.0;
  return (startOf(*to).position() - beginOf(from).position()).norm();
}

}  // namespace external_command
