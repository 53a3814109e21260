// SPDX-License-Identifier: Apache-2.0
#include "hybrid_astar.h"

#include <ompl/geometric/PathGeometric.h>

#include "ompl_space.h"

namespace external_command {

namespace ob = ompl::base;

HybridAStar::HybridAStar(const ob::SpaceInformationPtr& space, const Scene& scene, const Query& query,
                         const BoundingBox& area, std::size_t max_steps)
    : ob::Planner(space, "HybridAStar"), search_(scene, query, area), query_(query), max_steps_(max_steps) {
  specs_.approximateSolutions = false;
  specs_.directed = true;
}

ob::PlannerStatus HybridAStar::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  outcome_ = search_.run({}, {max_steps_, std::numeric_limits<double>::infinity(), [&stop] { return stop(); }});
  if (outcome_ != TwoWaySearch::Outcome::kFound) return ob::PlannerStatus::TIMEOUT;
  ob::PlannerSolution solution(pathOf(si_, query_.start, search_.arcs()));
  solution.setPlannerName(getName());
  pdef_->addSolutionPath(solution);
  return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace external_command
