// SPDX-License-Identifier: Apache-2.0
#include "zone_entry.h"

#include <algorithm>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/motion/collision_checker.h"

namespace external_command {

namespace {

constexpr double kStep = 2.0;        // of the grid of places [m]
constexpr double kRange = 40.0;      // [m]
constexpr int kHeadings = 8;         // tried at each place
constexpr std::size_t kEntries = 8;  // enough for a planner to choose from
constexpr double kTurnWeight = 4.0;  // of a radian off `from`'s heading, as distance [m]

}  // namespace

std::vector<Pose2d> zoneEntries(const CoverageArea& zone, const VehicleParams& vehicle, double margin,
                                const Pose2d& from, const CancelToken& cancel) {
  Region::Parts parts;
  parts.drivable = zone.outer;
  parts.non_drivable = zone.holes;
  parts.limits = zone.limits;
  const CollisionChecker checker(vehicle, margin, Region(std::move(parts)), cancel.checkpoint());
  std::vector<std::pair<double, Pose2d>> candidates;
  for (double x = -kRange; x <= kRange; x += kStep) {
    for (double y = -kRange; y <= kRange; y += kStep) {
      for (int i = 0; i < kHeadings; ++i) {
        const double turn = normalizeAngle(2.0 * M_PI * i / kHeadings);
        const Pose2d pose = compose(from, {x, y, turn});
        if (checker.isFree(pose)) candidates.emplace_back(std::hypot(x, y) + kTurnWeight * std::abs(turn), pose);
      }
    }
  }
  if (candidates.empty()) {
    throw NoPath(text("the vehicle fits nowhere into the zone within ", metres(kRange), " of its access at ",
                      at(from.position())));
  }
  const std::size_t count = std::min(kEntries, candidates.size());
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Pose2d> entries;
  for (std::size_t i = 0; i < count; ++i) entries.push_back(candidates[i].second);
  return entries;
}

}  // namespace external_command
