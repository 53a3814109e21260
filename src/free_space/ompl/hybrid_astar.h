// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ompl/base/Planner.h>

#include "free_space/search/staged_search.h"

namespace external_command {

/// searchInStages() as a planner of OMPL. The solution's states are joined by their shortest Reeds-Shepp curves.
class HybridAStar : public ompl::base::Planner {
 public:
  HybridAStar(const ompl::base::SpaceInformationPtr& space, const Scene& scene, const Query& query,
              const BoundingBox& area, std::size_t max_steps);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;

  /// What the last solve() came to, as the search tells it.
  const FirstPath& found() const { return found_; }

 private:
  Scene scene_;
  Query query_;
  BoundingBox area_;
  std::size_t max_steps_;
  FirstPath found_;
};

}  // namespace external_command
