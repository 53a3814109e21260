// SPDX-License-Identifier: Apache-2.0
#include "no_route.h"

#include <algorithm>
#include <optional>

#include "external_command/core/text.h"
#include "missing_links.h"
#include "route_builder.h"
#include "route_search.h"

namespace external_command {

namespace {

constexpr std::size_t kMostNamed = 5;

std::string pointName(const RouteQuery& query, std::size_t index) {
  if (index == 0) return "start";
  return index <= query.via.size() ? text("way_point[", index - 1, "]") : "goal";
}

const std::vector<LanePoint>& candidatesOf(const RouteQuery& query, std::size_t index) {
  if (index == 0) return query.starts;
  return index <= query.via.size() ? query.via[index - 1] : query.goals;
}

/// "goal (lane_7 at 12.00 m)", or how many candidates there are.
std::string described(const HdMap& map, const RouteQuery& query, std::size_t index) {
  const std::vector<LanePoint>& candidates = candidatesOf(query, index);
  const LanePoint& first = candidates.front();
  const Lane& lane = map.lane(first.lane);
  const std::string place = text("lane ", lane.id, " at ", metres(lane.statedS(first.s)));
  if (candidates.size() == 1) return text(pointName(query, index), " (", place, ")");
  return text(pointName(query, index), " (", candidates.size(), " candidates, the first ", place, ")");
}

/// Names the black list entries that `route` runs into.
std::string cutLanes(const HdMap& map, const std::vector<LaneRange>& black_list, const Route& route) {
  std::vector<std::string> ids;
  for (const RouteStep& step : route.steps) {
    const bool is_cut = std::any_of(black_list.begin(), black_list.end(), [&](const LaneRange& range) {
      return range.lane == step.lane && range.from_s <= step.to_s && range.to_s >= step.from_s;
    });
    const std::string& id = map.lane(step.lane).id;
    if (is_cut && std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
  }
  std::string names;
  for (std::size_t i = 0; i < std::min(ids.size(), kMostNamed); ++i) names += (i > 0 ? ", " : "") + ids[i];
  if (ids.size() > kMostNamed) names += text(" and ", ids.size() - kMostNamed, " more");
  return names;
}

/// The change with the least room of a route that was found without asking for room, if it has one.
std::string tightChange(const HdMap& map, const Route& route) {
  std::optional<std::size_t> tightest;
  for (std::size_t i = 0; i + 1 < route.steps.size(); ++i) {
    if (route.steps[i].change_after == LaneChange::kNone) continue;
    if (!tightest || route.steps[i].change_room < route.steps[*tightest].change_room) tightest = i;
  }
  if (!tightest) return "";
  const RouteStep& step = route.steps[*tightest];
  return text("from lane ", map.lane(step.lane).id, " to lane ", map.lane(route.steps[*tightest + 1].lane).id, " (",
              metres(step.change_room), ")");
}

}  // namespace

std::string whyNoRoute(const HdMap& map, const LaneGraph& graph, const RouterParams& params, const RouteQuery& query,
                       const CancelToken& cancel) {
  const BlockedLanes blocked(query.black_list), free({});
  const SearchResult failed = searchRoute(graph, nullptr, params, ChangeRule::kWithRoom, query, blocked, cancel);
  const std::string what = text("no route from ", described(map, query, failed.failed_leg), " to ",
                                described(map, query, failed.failed_leg + 1));
  for (const std::size_t end : {failed.failed_leg, failed.failed_leg + 1}) {
    const std::vector<LanePoint>& candidates = candidatesOf(query, end);
    const bool all_blocked = std::all_of(candidates.begin(), candidates.end(),
                                         [&](const LanePoint& point) { return blocked.contains(point.lane, point.s); });
    if (all_blocked) return text(what, ": the black list covers the ", pointName(query, end));
  }
  const SearchResult squeezed = searchRoute(graph, nullptr, params, ChangeRule::kWithoutRoom, query, blocked, cancel);
  const std::string change =
      squeezed.labels.empty() ? "" : tightChange(map, buildRoute(graph, blocked, squeezed.labels));
  if (!query.black_list.empty()) {
    const SearchResult unblocked = searchRoute(graph, nullptr, params, ChangeRule::kWithRoom, query, free, cancel);
    if (!unblocked.labels.empty()) {
      const std::string cut = cutLanes(map, query.black_list, buildRoute(graph, free, unblocked.labels));
      return text(what, ": the black list ",
                  change.empty() ? text("cuts it at lane ", cut) : text("leaves no room to change lanes, ", change),
                  "; without the black list there is a route");
    }
  }
  if (!change.empty()) {
    return text(what, ": there is no room to change lanes, ", change, "; a change needs ",
                metres(params.min_lane_change_length),
                " (~min_lane_change_length), or at least two arcs of the turning radius of ",
                metres(params.min_turning_radius));
  }
  return text(what, ": ", failed.reached_lanes, " lanes of ", map.lanes().size(),
              " were reached, none of which leads there",
              query.black_list.empty() ? "" : ", with or without the black list",
              missingLink(map, graph, candidatesOf(query, failed.failed_leg),
                          candidatesOf(query, failed.failed_leg + 1), cancel));
}

}  // namespace external_command
