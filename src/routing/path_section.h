// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/routing/reference_path.h"
#include "route_rows.h"

namespace external_command {

/// A stretch of a route whose path is made without looking at the rest. Where the route goes on at an end, that is a
/// calm place (LaneCuts), and the path of the next stretch begins where this one's ends.
struct PathSection {
  std::vector<RouteRow> rows;  ///< never empty
  bool follows = false;        ///< the route has come here from before
  bool goes_on = false;

  /// It depends on nothing but its lanes.
  bool isPlain() const { return follows && goes_on && rows.size() == 1; }
};

/// What the paths of a map are made with.
struct PathMaking {
  const HdMap& map;
  const VehicleParams& vehicle;
  const ReferencePathParams& params;
};

/// The path of a section, see referencePath(); its speeds are caps without a target speed. Empty where it is one point.
/// @param start  where the vehicle is, of a section that follows none.
/// @throws Cancelled
ReferencePath sectionPath(const PathMaking& making, const PathSection& section, const std::optional<Pose2d>& start,
                          const CancelToken& cancel);

}  // namespace external_command
