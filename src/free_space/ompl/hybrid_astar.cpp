// SPDX-License-Identifier: Apache-2.0
#include "hybrid_astar.h"

#include <ompl/geometric/PathGeometric.h>

#include <algorithm>

#include "first_path.h"
#include "free_space/search/shuffle_search.h"
#include "free_space/search/way_pose_search.h"
#include "ompl_space.h"

namespace external_command {

namespace ob = ompl::base;

namespace {

constexpr double kLongWay = 8.0;             ///< from which way poses are tried, in turning radii
constexpr std::size_t kSecondLook = 30'000;  ///< steps without a path that tell of a tight place ...
constexpr std::size_t kTightEnd = 3;         ///< ... at that end whose tree has come to this level, else between them

}  // namespace

HybridAStar::HybridAStar(const ob::SpaceInformationPtr& space, const Scene& scene, const Query& query,
                         const BoundingBox& area, std::size_t max_steps)
    : ob::Planner(space, "HybridAStar"),
      scene_(scene),
      query_(query),
      area_(area),
      max_steps_(max_steps),
      search_(scene, query, area) {
  specs_.approximateSolutions = false;
  specs_.directed = true;
}

ob::PlannerStatus HybridAStar::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  const auto arcs = search([&stop] { return stop(); });
  if (!arcs) return ob::PlannerStatus::TIMEOUT;
  ob::PlannerSolution solution(pathOf(si_, query_.start, *arcs));
  solution.setPlannerName(getName());
  pdef_->addSolutionPath(solution);
  return ob::PlannerStatus::EXACT_SOLUTION;
}

/// A little of the search itself, which suffices nearly always; then, unless something is too tight for the
/// vehicle, over way poses; then more of the search, shuffling where the tight place lies between start and goal, and
/// the search to its end: out of a tight end it finds a cheaper way than shuffling does.
std::optional<Arcs> HybridAStar::search(const std::function<bool()>& stop) {
  const auto runFor = [&](std::size_t steps) {
    outcome_ = search_.run({}, {steps, std::numeric_limits<double>::infinity(), stop});
    return outcome_ == TwoWaySearch::Outcome::kFound;
  };
  if (runFor(std::min(kFirstLookSteps, max_steps_))) return search_.arcs();
  if (outcome_ != TwoWaySearch::Outcome::kOutOfSteps || max_steps_ <= kFirstLookSteps) return std::nullopt;
  no_way_ = proveNoWay(scene_.index, area_, query_.start, query_.goal, {search_.toStart(), search_.toGoal()}, stop);
  if (no_way_) {
    outcome_ = TwoWaySearch::Outcome::kNone;
    return std::nullopt;
  }
  if ((query_.goal.position() - query_.start.position()).norm() > kLongWay * scene_.radius) {
    WayPoseSearch over_way_poses(scene_, query_, area_);
    if (over_way_poses.run(stop)) {
      outcome_ = TwoWaySearch::Outcome::kFound;
      return over_way_poses.arcs();
    }
  }
  if (runFor(std::min(kSecondLook, max_steps_))) return search_.arcs();
  if (outcome_ != TwoWaySearch::Outcome::kOutOfSteps || max_steps_ <= kSecondLook) return std::nullopt;
  if (search_.finestLevel() < kTightEnd) {
    ShuffleSearch shuffling(scene_, query_, area_, search_.toGoal());
    if (shuffling.run(stop)) {
      outcome_ = TwoWaySearch::Outcome::kFound;
      return shuffling.arcs();
    }
  }
  return runFor(max_steps_) ? std::optional<Arcs>(search_.arcs()) : std::nullopt;
}

}  // namespace external_command
