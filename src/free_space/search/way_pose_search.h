// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "guide_map.h"
#include "two_way_search.h"

namespace external_command {

/// Searches a long way in legs: from way pose to way pose along the guide's line, so that the time grows with the way's
/// length. A way pose stands where there is room, along the line or against it. Where a leg cannot be driven, its
/// tightest place is made dear and another line is tried.
class WayPoseSearch {
 public:
  /// @param area  the rear axle stays inside while searching.
  WayPoseSearch(const Scene& scene, const Query& query, const BoundingBox& area);

  /// @param stop  asked after every step of the legs' searches.
  /// @return whether a path was found. If not, there may be one all the same.
  bool run(const std::function<bool()>& stop);

  /// The path found by the last run, from start to goal.
  const Arcs& arcs() const { return arcs_; }

 private:
  /// A place of the line, and the two poses there: along the line, and against it.
  struct WayPlace {
    std::size_t index;  ///< of the line's point
    std::vector<Pose2d> poses;
  };

  std::vector<WayPlace> placesOn(const std::vector<GuidePoint>& line) const;
  WayPlace placeAt(const std::vector<GuidePoint>& line, std::size_t index) const;
  bool follow(const std::vector<GuidePoint>& line, const std::vector<WayPlace>& places, std::size_t next,
              const Pose2d& from, Arcs* arcs);
  bool searchLeg(const Pose2d& from, const Pose2d& to, bool is_last, const std::vector<GuidePoint>& line,
                 std::size_t first, std::size_t last, Arcs* arcs) const;

  Scene scene_;
  Query query_;
  BoundingBox area_;
  std::function<bool()> stop_;
  std::size_t farthest_ = 0;  ///< place that was headed for
  std::size_t tries_ = 0;     ///< legs that are left to be tried on this line
  Arcs arcs_;
};

}  // namespace external_command
