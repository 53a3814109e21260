// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "free_space/search/two_way_search.h"
#include "path_improver.h"
#include "track.h"

namespace external_command {

/// Uses whatever time it gets to make a path cheaper: improves it locally and, when that no longer helps, searches anew
/// with other settings for a path of another shape, of all of the way or, where that is long, of parts around its
/// cusps.
class AnytimeImprover {
 public:
  AnytimeImprover(const Scene& scene, const DrivingCost& cost, const Query& query, const BoundingBox& area,
                  std::uint64_t seed);

  /// @param arcs  a free path for the query.
  Arcs improve(const Arcs& arcs, WorkBudget* budget);

 private:
  Arcs withPartSearched(const Arcs& arcs, WorkBudget* budget);
  double beginOfPart(const Track& track, double length);

  Scene scene_;
  DrivingCost cost_;
  Query query_;
  BoundingBox area_;
  Random random_;
  PathImprover improver_;
};

}  // namespace external_command
