// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/routing/router.h"
#include "route_index.h"

namespace external_command {

/// Lower bounds of what it costs to drive on to the nearest of some targets, each looked up when it is first asked for:
/// lazy potentials (Strasser, Zeitz, "A fast and tight heuristic for A* in road networks", 2021). They hold whatever a
/// black list blocks. One at a time per thread: the memory is kept from one leg to the next. The arguments must
/// outlive it.
class GoalDistances {
 public:
  GoalDistances(const LaneGraph& graph, const RouteIndex& index);

  void setTargets(const std::vector<LanePoint>& targets);

  /// From `s` on a lane on, with a stretch of road counted from there [m]; far more than any route costs where no
  /// target can be reached.
  double from(LaneIndex lane, double s);

 private:
  struct Workspace;

  double countedRest(LaneIndex lane, double s) const;
  template <class IsThere>
  const std::vector<std::uint32_t>& pathUp(std::uint32_t rank, const IsThere& is_there);
  void climb(const LanePoint& target);
  std::int32_t fromEnd(std::uint32_t rank);

  const LaneGraph& graph_;
  const RouteIndex& index_;
  Workspace& work_;
};

}  // namespace external_command
