// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/router.h"

#include <algorithm>
#include <cmath>

#include "blocked_lanes.h"
#include "external_command/core/parameter_range.h"
#include "external_command/core/text.h"
#include "no_route.h"
#include "route_builder.h"
#include "route_search.h"
#include "router_content.h"

namespace external_command {

namespace {

constexpr double kOutside = 0.001;  // [m] by which `s` may miss its lane

void requirePoint(const LaneGraph& graph, const HdMap& map, const std::string& name, LanePoint* point) {
  if (point->lane >= graph.size()) {
    throw InvalidRequest(text(name, " names lane ", point->lane, "; the map has ", graph.size(), " lanes"));
  }
  const Lane& lane = map.lane(point->lane);
  if (!graph.isRoutable(point->lane)) {
    throw InvalidRequest(text(name, " is on lane ", lane.id, ", which is not for driving"));
  }
  if (!(point->s >= -kOutside && point->s <= lane.length() + kOutside)) {  // catches NaN
    throw InvalidRequest(
        text(name, " has s ", point->s, " on lane ", lane.id, "; it must lie in [0, ", metres(lane.length()), "]"));
  }
  if (!(point->price >= 0.0)) throw InvalidRequest(text(name, " has the price ", point->price));
  point->s = std::clamp(point->s, 0.0, lane.length());
}

void requireEnd(const LaneGraph& graph, const HdMap& map, const std::string& name, std::vector<LanePoint>* candidates) {
  if (candidates->empty()) throw InvalidRequest(text("the route has no ", name));
  for (LanePoint& point : *candidates) requirePoint(graph, map, name, &point);
}

/// The query, checked, with every `s` inside its lane.
RouteQuery checked(RouteQuery query, const LaneGraph& graph, const HdMap& map) {
  requireEnd(graph, map, "start", &query.starts);
  for (std::size_t i = 0; i < query.via.size(); ++i) requireEnd(graph, map, text("way_point[", i, "]"), &query.via[i]);
  requireEnd(graph, map, "goal", &query.goals);
  for (const LaneRange& range : query.black_list) {
    if (range.lane >= graph.size() || !(range.from_s <= range.to_s)) {
      throw InvalidRequest(text("black list entry on lane ", range.lane, " from ", range.from_s, " to ", range.to_s,
                                " m is not a part of a lane of the map"));
    }
  }
  return query;
}

/// Names the changes that are shorter than they should be.
void warnOfTightChanges(const HdMap& map, double min_length, Route* route) {
  for (std::size_t i = 0; i + 1 < route->steps.size(); ++i) {
    const RouteStep& step = route->steps[i];
    if (step.change_after == LaneChange::kNone) continue;
    double room = 0.0;
    for (const LaneRange& range : step.change_onto) room += range.to_s - range.from_s;
    if (room > min_length - 1e-6) continue;
    route->warnings.push_back(text("the change from lane ", map.lane(step.lane).id, " to lane ",
                                   map.lane(route->steps[i + 1].lane).id, " has only ", metres(room), " of the ",
                                   metres(min_length), " it should have (~min_lane_change_length)"));
  }
}

/// Way points that lie behind one another have counted as reached, and the goal after them.
void warnOfGoalBehind(const HdMap& map, const LanePoint& goal, double stopping_error, Route* route) {
  const RouteStep& last = route->steps.back();
  const Point2d end = map.lane(last.lane).center.pointAt(last.to_s);
  const double distance = (map.lane(goal.lane).center.pointAt(goal.s) - end).norm();
  if (distance <= stopping_error + kOutside) return;
  route->warnings.push_back(text("the route ends ", metres(distance),
                                 " beyond its goal: way points that lie behind one "
                                 "another by no more than ",
                                 metres(stopping_error),
                                 " (~stopping_error) count as reached, and so does the goal after them"));
}

}  // namespace

void RouterParams::validate() const {
  requireParameter("lane_change_price", lane_change_price, 0.0, 1e6);
  requireParameter("tight_lane_change_price", tight_lane_change_price, 0.0, 1e6);
  requireParameter("min_lane_change_length", min_lane_change_length, 0.1, 1000.0);
  requireParameter("stopping_error", stopping_error, 0.0, 10.0);
  requireParameter("min_turning_radius", min_turning_radius, 0.1, 100.0);
}

Router::Router(std::shared_ptr<const HdMap> map, const RouterParams& params) {
  params.validate();
  if (!map) throw NotReady("no map is loaded");
  content_ = std::make_unique<const RouterContent>(std::move(map), params);
}

Router::Router(std::unique_ptr<const RouterContent> content) : content_(std::move(content)) {
  content_->params.validate();
}

Router::~Router() = default;

const HdMap& Router::map() const { return *content_->map; }
const std::shared_ptr<const HdMap>& Router::mapPtr() const { return content_->map; }
const RouterParams& Router::params() const { return content_->params; }

Route Router::findRoute(const RouteQuery& request, const CancelToken& cancel) const {
  const LaneGraph& graph = content_->graph;
  const RouteQuery query = checked(request, graph, map());
  const BlockedLanes blocked(query.black_list);
  const SearchResult found =
      searchRoute(graph, &content_->index, content_->params, ChangeRule::kWithRoom, query, blocked, cancel);
  if (found.labels.empty()) throw NoRoute(whyNoRoute(map(), graph, content_->params, query, cancel));
  Route route = buildRoute(graph, blocked, found.labels);
  warnOfTightChanges(map(), content_->params.min_lane_change_length, &route);
  warnOfGoalBehind(map(), query.goals[route.goal], content_->params.stopping_error, &route);
  return route;
}

}  // namespace external_command
