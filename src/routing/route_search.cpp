// SPDX-License-Identifier: Apache-2.0
#include "route_search.h"

namespace external_command {

SearchResult searchRoute(const LaneGraph& graph, const RouteIndex* index, const RouterParams& params, ChangeRule rule,
                         const RouteQuery& query, const BlockedLanes& blocked, const CancelToken& cancel) {
  LabelSearch search(graph, index, params, rule, blocked, cancel);
  std::vector<std::int32_t> ends;
  for (std::size_t leg = 0; leg <= query.via.size(); ++leg) {
    const bool is_last = leg == query.via.size();
    search.beginLeg(is_last ? query.goals : query.via[leg]);
    for (std::size_t i = 0; leg == 0 && i < query.starts.size(); ++i) {
      search.addStart(query.starts[i], static_cast<std::int32_t>(i));
    }
    for (const std::int32_t end : ends) search.leaveFrom(end);
    ends = search.drive(is_last ? LabelSearch::Reach::kToFirst : LabelSearch::Reach::kToAll);
    if (ends.empty()) return {{}, leg, search.reachedLanes(), search.foundLabels()};
  }
  return {search.wayTo(ends.front()), 0, 0, search.foundLabels()};
}

}  // namespace external_command
