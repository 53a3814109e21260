// SPDX-License-Identifier: Apache-2.0
#include "first_path.h"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <limits>
#include <mutex>

#include "hybrid_astar.h"
#include "ompl_space.h"

namespace external_command {

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

class SeededSimplifier : public og::PathSimplifier {
 public:
  SeededSimplifier(const ob::SpaceInformationPtr& space, std::uint64_t seed) : og::PathSimplifier(space) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>(seed));
  }
};

ob::PlannerPtr makeOmplPlanner(const std::string& name, const ob::SpaceInformationPtr& space) {
  if (name == "rrtstar") return std::make_shared<og::RRTstar>(space);
  if (name == "kpiece") return std::make_shared<og::KPIECE1>(space);
  return std::make_shared<og::RRTConnect>(space);
}

ob::ProblemDefinitionPtr problemOf(const ob::SpaceInformationPtr& space, const Query& query) {
  auto problem = std::make_shared<ob::ProblemDefinition>(space);
  ob::ScopedState<> start(space), goal(space);
  setPose(query.start, start.get());
  setPose(query.goal, goal.get());
  problem->setStartAndGoalStates(start, goal);
  // The first exact solution will do: without a threshold the optimising planners use up all of the time.
  auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(space);
  objective->setCostThreshold(ob::Cost(std::numeric_limits<double>::infinity()));
  problem->setOptimizationObjective(objective);
  return problem;
}

/// OMPL takes a seed once per process, before its first random number.
void seedOmplOnce(std::uint64_t seed) {
  static std::once_flag seeded;
  std::call_once(seeded, [seed] { ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed)); });
}

}  // namespace

const std::vector<std::string>& omplPlannerNames() {
  static const std::vector<std::string> names{"rrtconnect", "rrtstar", "kpiece"};
  return names;
}

FirstPath findFirstPath(const Scene& scene, const Query& query, const BoundingBox& area,
                        const FirstPathRequest& request, const StopCondition& stop) {
  const std::vector<std::string>& names = omplPlannerNames();
  const bool is_own = std::find(names.begin(), names.end(), request.planner) == names.end();
  if (!is_own) seedOmplOnce(request.seed);
  const ob::SpaceInformationPtr space = makeSpace(scene, area, request.seed);
  const ob::ProblemDefinitionPtr problem = problemOf(space, query);
  const auto own = is_own ? std::make_shared<HybridAStar>(space, scene, query, area, request.max_steps) : nullptr;
  const ob::PlannerPtr planner = is_own ? own : makeOmplPlanner(request.planner, space);
  planner->setProblemDefinition(problem);
  planner->setup();
  const ob::PlannerTerminationCondition stopped([&stop] { return stop.isReached(); });
  const ob::PlannerStatus status = planner->solve(stopped);
  // An approximate solution is none.
  if (status != ob::PlannerStatus::EXACT_SOLUTION) {
    return own ? own->found() : FirstPath{};
  }
  og::PathGeometric path = *problem->getSolutionPath()->as<og::PathGeometric>();
  if (!is_own) SeededSimplifier(space, request.seed).simplify(path, stopped);
  return {TwoWaySearch::Outcome::kFound, arcsOf(path, scene.radius), {}};
}

}  // namespace external_command
