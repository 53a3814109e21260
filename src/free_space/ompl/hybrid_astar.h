// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ompl/base/Planner.h>

#include <functional>
#include <optional>

#include "free_space/search/no_way.h"
#include "free_space/search/two_way_search.h"

namespace external_command {

/// TwoWaySearch, over way poses where the way is long, as a planner of OMPL. The solution's states are joined by their
/// shortest Reeds-Shepp curves.
class HybridAStar : public ompl::base::Planner {
 public:
  HybridAStar(const ompl::base::SpaceInformationPtr& space, const Scene& scene, const Query& query,
              const BoundingBox& area, std::size_t max_steps);

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& stop) override;

  /// How the last solve() ended.
  TwoWaySearch::Outcome outcome() const { return outcome_; }

  /// The proof by which it ended with kNone; nullopt where the search came to its end.
  const std::optional<NoWay>& noWay() const { return no_way_; }

 private:
  std::optional<Arcs> search(const std::function<bool()>& stop);

  Scene scene_;
  Query query_;
  BoundingBox area_;
  std::size_t max_steps_;
  TwoWaySearch search_;
  TwoWaySearch::Outcome outcome_ = TwoWaySearch::Outcome::kStopped;
  std::optional<NoWay> no_way_;
};

}  // namespace external_command
