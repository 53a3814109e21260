// SPDX-License-Identifier: Apache-2.0
#include "links.h"

#include <algorithm>
#include <cmath>

#include "connector.h"

namespace external_command {

namespace {

constexpr double kDifference = 0.1;          ///< of a way's price from the guess that does not matter [m]
constexpr double kNear = 8.0;                ///< ends that a turn leads between, not a transfer [turning radii]
constexpr std::size_t kTurnsTried = 8;       ///< in the guess
constexpr double kChangesWithoutRoom = 2.0;  ///< of gear, more than the cheapest turn's, where none of them has room
constexpr double kLoop = 25.0;      ///< longer, at most, than the cheapest turn where none has room [turning radii]
constexpr double kRoomStep = 0.25;  ///< between places looked at [turning radii]

}  // namespace

Links::Links(const Field& field, const std::vector<Work>& works, Routes* routes)
    : field_(field), works_(works), routes_(*routes) {}

std::uint64_t Links::idOf(const Step* from, const Step* to) {
  const auto id = [](const Step* step) {
    return step == nullptr ? 0 : (static_cast<std::uint64_t>(step->work + 1) << 14U) + step->way;
  };
  return (id(from) << 32U) + id(to);
}

Links::Cost Links::costOf(const Step* from, const Step* to) {
  if (to == nullptr || (from == nullptr && !field_.start())) return {0.0F, 0.0F};
  const auto [entry, is_new] = known_.try_emplace(idOf(from, to), Cost{0.0F, 0.0F});
  if (is_new) entry->second = guess(beginOf(from), startOf(*to));
  return entry->second;
}

Links::Cost Links::guess(const Pose2d& from, const Pose2d& to) {
  const double straight = (to.position() - from.position()).norm();
  const double detour = routes_.distance(from.position(), to.position()) - straight;
  const std::vector<SteeringCurve> turns = turnsWithoutObstacles(from, to, field_.radius(), field_.gearPrice());
  const SteeringCurve* turn = &turns.front();
  double more = detour;
  if (detour < kDifference && straight < kNear * field_.radius()) {
    const std::size_t most = std::min(kTurnsTried, turns.size());
    std::size_t i = 0;
    while (i < most && !hasRoom(from, turns[i])) ++i;
    turn = &turns[i < most ? i : 0];
    more = i < most
               ? 0.0
               : field_.radius() * std::min(kLoop, 1.0 + kChangesWithoutRoom * field_.gearPrice() / field_.radius());
  }
  return {static_cast<float>(turn->cost + more), static_cast<float>(turn->length + more)};
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
      if (!routes_.isOpen(pose.position() + (arc.length > 0.0 ? nose : tail) * ahead)) return false;
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
  way = Connector(field_).connect(driven ? &*driven : nullptr, beginOf(from), curveOf(*to));
  const double guessed = price(from, to), length = way ? way->length() : kNoWay;
  const double found = length + (way ? field_.gearPrice() * way->gearChangesBetween() : 0.0);
  known_[idOf(from, to)] = {static_cast<float>(found), static_cast<float>(length)};
  return std::abs(found - guessed) > kDifference;
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
