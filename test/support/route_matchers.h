// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "external_command/core/path.h"
#include "external_command/routing/router.h"

namespace external_command {

/// Every step lies on its lane and leads on to a successor, or, abreast, to the stated neighbour; what lies beside the
/// room of a change is connected too, and neighbour of a lane of that room.
testing::AssertionResult isConnected(const Route& route, const HdMap& map);

/// Each lane change has at least the length that two opposite arcs of `radius` [m] take over the distance of the two
/// centre lines.
testing::AssertionResult changesHaveRoom(const Route& route, const HdMap& map, double radius);

/// No step, and no lane beside the room of a change, touches a part of the black list.
testing::AssertionResult avoids(const Route& route, const HdMap& map, const std::vector<LaneRange>& black_list);

/// The first step begins at the start that the route says it took, the last one ends at its goal.
testing::AssertionResult beginsAndEndsAsAsked(const Route& route, const RouteQuery& query);

/// At least two points, finite, no two further apart than `spacing` [m], `s` their arc length, heading along the motion
/// and turning as the curvature says, the last point at rest.
testing::AssertionResult isContinuous(const Path& path, double spacing);

/// Every point lies within `distance` [m] of the centre line of a lane of the route or beside a change of it.
testing::AssertionResult staysNear(const Path& path, const Route& route, const HdMap& map, double distance);

/// Ids of the route's lanes, in order: "a b c".
std::string laneIds(const Route& route, const HdMap& map);

/// The passages of a route, from right to left, for comparison: "{a b|c d*} {e*}"; a star marks what can exit.
std::string drawn(const std::vector<RouteSegment>& segments, const HdMap& map);

}  // namespace external_command
