// SPDX-License-Identifier: Apache-2.0
#include "staged_search.h"

#include <algorithm>
#include <limits>

#include "shuffle_search.h"
#include "way_pose_search.h"

namespace external_command {

namespace {

constexpr double kLongWay = 8.0;             ///< from which way poses are tried, in turning radii
constexpr std::size_t kSecondLook = 30'000;  ///< steps without a path that tell of a tight place ...
constexpr std::size_t kTightEnd = 3;         ///< ... at that end whose tree has come to this level, else between them

}  // namespace

FirstPath searchInStages(const Scene& scene, const Query& query, const BoundingBox& area, std::size_t max_steps,
                         const std::function<bool()>& stop) {
  using Outcome = TwoWaySearch::Outcome;
  TwoWaySearch search(scene, query, area);
  Outcome outcome = Outcome::kStopped;
  // whether more may be found with more steps
  const auto goesOnAfter = [&](std::size_t steps) {
    outcome = search.run({}, {std::min(steps, max_steps), std::numeric_limits<double>::infinity(), stop});
    return outcome == Outcome::kOutOfSteps && max_steps > steps;
  };
  const auto result = [&] { return FirstPath{outcome, outcome == Outcome::kFound ? search.arcs() : Arcs(), {}}; };
  if (!goesOnAfter(kFirstLookSteps)) return result();
  if (auto no_way = proveNoWay(scene.index, area, query.start, query.goal, {search.toStart(), search.toGoal()}, stop)) {
    return {Outcome::kNone, {}, std::move(no_way)};
  }
  if ((query.goal.position() - query.start.position()).norm() > kLongWay * scene.radius) {
    WayPoseSearch over_way_poses(scene, query, area);
    if (over_way_poses.run(stop)) return {Outcome::kFound, over_way_poses.arcs(), {}};
  }
  if (!goesOnAfter(kSecondLook)) return result();
  if (search.finestLevel() < kTightEnd) {
    ShuffleSearch shuffling(scene, query, area, search.toGoal());
    if (shuffling.run(stop)) return {Outcome::kFound, shuffling.arcs(), {}};
  }
  goesOnAfter(max_steps);
  return result();
}

}  // namespace external_command
