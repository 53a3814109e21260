// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/map/hd_map.h"

namespace external_command {

/// A point on a lane's centre line.
struct LanePoint {
  LaneIndex lane = 0;
  double s = 0.0;      ///< [m]
  double price = 0.0;  ///< added to the cost of a route that takes this candidate as start, way point or goal [m]
};

/// A part of a lane, ends included.
struct LaneRange {
  LaneIndex lane = 0;
  double from_s = 0.0;  ///< [m]
  double to_s = 0.0;    ///< [m]
};

enum class LaneChange { kNone, kLeft, kRight };

/// One stretch of the route on one lane; a single point where a change ends just there. The next step is the lane's
/// successor, or, abreast of `to_s`, the neighbour lane that `change_after` names.
struct RouteStep {
  LaneIndex lane = 0;
  double from_s = 0.0;  ///< [m]
  double to_s = 0.0;    ///< [m]
  LaneChange change_after = LaneChange::kNone;
  /// Of a change: it may begin anywhere in the last `change_room` metres driven before `to_s`, and is done at `to_s`.
  /// The room reaches back over earlier steps where it is longer than this one.
  double change_room = 0.0;
  /// Of a change: what lies abreast of its room on the lanes changed to; ends where the next step begins.
  std::vector<LaneRange> change_onto = {};
};

/// What is asked for: any of `starts`, then each way point in order (any candidate of it), then any of `goals`.
struct RouteQuery {
  std::vector<LanePoint> starts;            ///< at least one
  std::vector<std::vector<LanePoint>> via;  ///< in order; at least one candidate each
  std::vector<LanePoint> goals;             ///< at least one
  std::vector<LaneRange> black_list;        ///< parts of lanes that may not be touched
};

struct Route {
  std::vector<RouteStep> steps;  ///< never empty
  double distance = 0.0;         ///< driven [m]; lanes side by side count as the last one taken
  double cost = 0.0;             ///< what the route was chosen by: `distance` and all prices [m]
  std::size_t start = 0;         ///< which of `starts` was taken
  std::size_t goal = 0;          ///< which of `goals` was taken
  std::vector<std::size_t> via;  ///< which candidate of each way point was taken
  std::vector<std::string> warnings;
};

struct RouterParams {
  /// A lane change is made only where it saves more than this [m].
  double lane_change_price = 50.0;
  /// Wished for a change to the neighbour lane, along the road [m].
  double min_lane_change_length = 10.0;
  /// Of the vehicle. A change is never shorter than two opposite arcs over the lateral distance of the lanes, which
  /// take at most four fifths of the curvature that this radius allows, less that of the lanes [m].
  double min_turning_radius = 5.0;
  /// A change with less room than `min_lane_change_length` is made only where it saves this much more [m].
  double tight_lane_change_price = 30.0;

  /// A way point or goal that lies no further behind the start, behind the way point before it, or behind where that
  /// was passed, counts as reached there [m].
  double stopping_error = 0.5;

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

struct RouterContent;  // as src/routing has it

/// Shortest routes over the lanes of one map. Immutable, thread-safe, no caches.
class Router {
 public:
  Router(std::shared_ptr<const HdMap> map, const RouterParams& params);

  /// One that was made before.
  explicit Router(std::unique_ptr<const RouterContent> content);
  ~Router();

  const HdMap& map() const;
  const std::shared_ptr<const HdMap>& mapPtr() const;
  const RouterParams& params() const;

  /// The cheapest route: metres driven, a price for each lane change, and those of the candidates taken; among equals
  /// that with the fewest changes. A goal behind the start on its own lane means a loop, but for `stopping_error`.
  /// @throws InvalidRequest  an end is missing, or `s` lies outside its lane by more than 1 mm.
  /// @throws NoRoute  the lanes exist but nothing connects them, or the black list cuts every connection; the text says
  ///                  which leg, how many candidates were tried, and whether it would work without the black list.
  /// @throws Cancelled  `cancel` was raised; polled at least every 1 ms.
  Route findRoute(const RouteQuery& query, const CancelToken& cancel) const;

  /// For what keeps routers.
  const RouterContent& content() const { return *content_; }

 private:
  std::unique_ptr<const RouterContent> content_;
};

/// Passages of the route as the RoutingResponse states them: the passages of a segment lie side by side.
struct RoutePassage {
  std::vector<LaneRange> lanes;
  bool can_exit = true;
  LaneChange change = LaneChange::kNone;  ///< to which neighbour passage the route changes
};

struct RouteSegment {
  std::string id;                      ///< of the road where the map names it, else of the first lane
  std::vector<RoutePassage> passages;  ///< from right to left as one looks along the road
};

std::vector<RouteSegment> toSegments(const HdMap& map, const Route& route);

}  // namespace external_command
