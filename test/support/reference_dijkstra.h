// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/routing/router.h"

namespace external_command {

/// The cost of the cheapest route of `query`, the simplest way there is: Dijkstra over whole lanes, where a lane can be
/// left for its neighbour only where it is entered, in no room and for `change_price` [m]. Lanes of which any part is
/// black-listed do not exist. Independent of Router.
/// @return infinity where there is no route.
double referenceCost(const HdMap& map, const RouteQuery& query, double change_price);

}  // namespace external_command
