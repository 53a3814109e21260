// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "external_command/core/path.h"
#include "external_command/routing/router.h"

namespace external_command {

struct ReferencePathParams {
  double spacing = 0.5;               ///< between two points [m]
  double lane_change_length = 30.0;   ///< wished for a smooth change; less where the route leaves less [m]
  double default_speed_limit = 13.9;  ///< where the map gives none [m/s]
  bool refuse_undrivable = false;     ///< a path that bends more than the vehicle can; false: it is only told

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

/// What a reference path is asked for, beside its route.
struct ReferencePathQuery {
  double target_speed = 0.0;  ///< [m/s]; 0: not given
  /// Where the vehicle is. The path begins there instead of on the centre line, and merges onto it.
  std::optional<Pose2d> start = std::nullopt;
  CancelToken cancel = {};
};

/// A stretch that bends more than the vehicle can, at its tightest place.
struct TightLane {
  LaneIndex lane = 0;
  Point2d position = Point2d::Zero();  ///< [m]
  double radius = 0.0;                 ///< of the path there [m]
};

/// A stretch on which a part of the vehicle leaves the lanes, at its worst place.
struct LeftLane {
  LaneIndex lane = 0;
  Point2d position = Point2d::Zero();  ///< of the vehicle [m]
  double excess = 0.0;                 ///< of the corner that is farthest beyond the boundary [m]
};

struct ReferencePath {
  Path path;
  std::vector<TightLane> tight;  ///< in order along the path; empty: it can be driven
  std::vector<LeftLane> left;    ///< in order along the path; by more than 0.2 m
};

/// The centre line of the route with its lane changes as smooth transitions (quintic in the lateral offset, so heading
/// and curvature have no step), sampled at `spacing`; the last point lies exactly on the route's end.
///
/// Where that bends more than the vehicle can, or faster than it can be steered at a crawl, or leads the vehicle's
/// front out of the lane, the path leaves the centre line within the boundaries of the lane, and of neighbours in the
/// same direction where that does not suffice. Overlapping ends of lanes and folds are left out.
///
/// Speeds are caps, see limitSpeeds(): the lanes' limits, lowered to the target speed, and to what the steering can
/// follow.
/// @throws NoPath  it bends more than the vehicle can, and `refuse_undrivable` is set.
/// @throws Cancelled
ReferencePath referencePath(const HdMap& map, const Route& route, const VehicleParams& vehicle,
                            const ReferencePathParams& params, const ReferencePathQuery& query);

/// A text for each of the first twenty, with lane, place, radius and the vehicle's, and one that counts the others.
std::vector<std::string> describe(const HdMap& map, const std::vector<TightLane>& tight, const VehicleParams& vehicle);

/// The same with lane, place and how much.
std::vector<std::string> describe(const HdMap& map, const std::vector<LeftLane>& left);

}  // namespace external_command
