// SPDX-License-Identifier: Apache-2.0
#include "change_room.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kPiece = 5.0;        // [m] over which bend and distance of the lanes are taken together
constexpr double kMostPieces = 16.0;  // of a pair of lanes
constexpr double kArcShare = 0.8;     // of the vehicle's curvature that arcs and lanes may take
constexpr double kLeastShare = 0.05;  // of it, for the arcs alone
constexpr double kAlike = 0.05;       // needs that differ by no more are taken together [m]

/// Two lanes abreast, at one place.
struct Abreast {
  Pose2d a, b;

  double offset() const { return std::abs(cross(unitVector(a.heading), b.position() - a.position())); }
};

/// Mean curvature; over a short stretch, where the kink of a coarse line says little, of a longer one with that turn.
double bendBetween(const Pose2d& from, const Pose2d& to) {
  const double length = (to.position() - from.position()).norm();
  return std::abs(angleBetween(from.heading, to.heading)) / std::max(length, 0.5 * kPiece);
}

double needBetween(const Abreast& from, const Abreast& to, double min_turning_radius) {
  const double full_lock = 1.0 / min_turning_radius;
  const double bend = std::max(bendBetween(from.a, to.a), bendBetween(from.b, to.b));
  const double curvature = std::max(kArcShare * full_lock - bend, kLeastShare * full_lock);
  return twoArcLength(std::max(from.offset(), to.offset()), 1.0 / curvature);
}

}  // namespace

double twoArcLength(double offset, double radius) {
  return offset >= 2.0 * radius ? 2.0 * radius : std::sqrt(offset * (4.0 * radius - offset));
}

std::vector<ChangeNeed> changeNeeds(const HdMap& map, LaneIndex a, const LanePair& pair, double min_turning_radius) {
  const Polyline &center_a = map.lane(a).center, &center_b = map.lane(pair.b).center;
  const double length = pair.a_to - pair.a_from;
  const auto pieces = static_cast<std::size_t>(std::clamp(std::ceil(length / kPiece), 1.0, kMostPieces));
  const auto place = [&](std::size_t i) {
    const double s = pair.a_from + length * static_cast<double>(i) / static_cast<double>(pieces);
    return Abreast{center_a.poseAt(s), center_b.poseAt(pair.toB(s))};
  };
  std::vector<ChangeNeed> needs;
  Abreast from = place(0);
  for (std::size_t i = 0; i < pieces; ++i) {
    const Abreast to = place(i + 1);
    const double need = needBetween(from, to, min_turning_radius);
    const double s = pair.a_from + length * static_cast<double>(i) / static_cast<double>(pieces);
    if (needs.empty() || std::abs(needs.back().length - need) > kAlike) {
      needs.push_back({static_cast<float>(s), static_cast<float>(need)});
    }
    from = to;
  }
  return needs;
}

}  // namespace external_command
