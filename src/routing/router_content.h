// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "lane_graph.h"
#include "route_index.h"

namespace external_command {

/// What a Router holds.
struct RouterContent {
  RouterContent(std::shared_ptr<const HdMap> hd_map, const RouterParams& router_params)
      : map(std::move(hd_map)), params(router_params), graph(*map, params), index(graph, params) {}

  /// @param kept_index  as it was made of the same map with the same parameters.
  RouterContent(std::shared_ptr<const HdMap> hd_map, const RouterParams& router_params, RouteIndex kept_index)
      : map(std::move(hd_map)), params(router_params), graph(*map, params), index(std::move(kept_index)) {}

  std::shared_ptr<const HdMap> map;
  RouterParams params;
  LaneGraph graph;
  RouteIndex index;
};

}  // namespace external_command
