// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

/// What can be wrong with a map. The reader finds those up to kSpaceHeadingAcross while it resolves one, `check_map`
/// the others.
enum class MapFault : unsigned char {
  kLaneUnusable,
  kLaneIdRepeated,
  kLaneTypeUnknown,
  kLaneTypeMissing,
  kLaneWithoutLength,
  kLaneLengthWrong,
  kBoundaryUnusable,
  kWidthSampleUnusable,
  kSpeedLimitUnusable,
  kReferenceDangling,
  kLinkBackwardsOnly,
  kLaneOfTwoRoads,
  kNeighbourWrongSide,
  kNeighbourOncoming,
  kNeighbourFar,
  kNeighboursMissing,
  kLinkBroken,
  kLinkGap,
  kLinkOverlap,
  kLinkKink,
  kFold,
  kPolygonUnusable,
  kCornersCrossed,
  kObjectIdRepeated,
  kOverlapDangling,
  kOverlapRangeUnusable,
  kSpaceWithoutOverlap,
  kSpaceHeadingMissing,
  kSpaceHeadingInDegrees,
  kSpaceHeadingAcross,

  kDirectionBackward,
  kSpeedLimitMissing,
  kSpeedLimitAbsurd,
  kLaneNarrow,
  kLaneWide,
  kLaneSharpBend,
  kWidthMissing,
  kWidthDisagrees,
  kBoundaryWrongSide,
  kBoundaryReversed,
  kLinkOneSided,
  kNeighbourOneSided,
  kNeighbourNotOncoming,
  kLaneWithoutRoad,
  kJunctionDangling,
  kIdRepeated,
  kLinkMissing,
  kLinkHeightJump,
  kLaneIsolated,
  kLaneUnreachable,
  kLaneDeadEnd,
  kOverlapOneSided,
  kOverlapBeyondLane,
  kOverlapElsewhere,
  kSpaceWithoutAccess,
  kSpaceTooSmall,
  kSpaceSmall,
};

enum class FaultSeverity {
  kWarning,  ///< put right, derived, done without, or odd; commands are carried out all the same
  kError,    ///< something of the map is not there for commands, or misleads them
};

struct MapFaultKind {
  MapFault fault;
  FaultSeverity severity;
  const char* name;    ///< "link_gap", for programs
  const char* what;    ///< follows a number: "links whose ends do not meet"
  const char* advice;  ///< what to do about it: "move the ends together"
};

/// Every kind, in the order of MapFault.
const std::vector<MapFaultKind>& mapFaultKinds();
const MapFaultKind& kindOf(MapFault fault);

/// One fault of a map.
struct MapFinding {
  MapFault fault;
  FaultSeverity severity;
  std::vector<std::string> ids;  ///< of the objects concerned, the faulty one first
  std::optional<Point2d> place;  ///< in the coordinates of the map, its origin subtracted [m]
  double size;                   ///< how much, where the fault has a size, else 0 [m, rad, ...]
  std::string what;              ///< which and how much: "a to b, 1.90 m"
};

/// All faults of one kind: how many, and an example.
struct MapWarning {
  std::string what;  ///< "3 references to lanes that do not exist, e.g. successor road_1_lane_9 of road_1_lane_2"
  std::size_t count = 0;
};

}  // namespace external_command
