// SPDX-License-Identifier: Apache-2.0
#include "hybrid_astar.h"

#include <ompl/geometric/PathGeometric.h>

#include "ompl_space.h"

namespace external_command {

namespace ob = ompl::base;

HybridAStar::HybridAStar(const ob::SpaceInformationPtr& space, const Scene& scene, const Query& query,
                         const BoundingBox& area, std::size_t max_steps)
    : ob::Planner(space, "HybridAStar"), scene_(scene), query_(query), area_(area), max_steps_(max_steps) {
  specs_.approximateSolutions = false;
  specs_.directed = true;
}

ob::PlannerStatus HybridAStar::solve(const ob::PlannerTerminationCondition& stop) {
  checkValidity();
  found_ = searchInStages(scene_, query_, area_, max_steps_, [&stop] { return stop(); });
  if (found_.outcome != TwoWaySearch::Outcome::kFound) return ob::PlannerStatus::TIMEOUT;
  ob::PlannerSolution solution(pathOf(si_, query_.start, found_.arcs));
  solution.setPlannerName(getName());
  pdef_->addSolutionPath(solution);
  return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace external_command
