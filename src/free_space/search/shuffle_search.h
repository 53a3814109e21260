// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "holonomic_search.h"
#include "two_way_search.h"

namespace external_command {

/// For places so tight that the vehicle has to drive to and fro many times: finds a way for a body that could move
/// sideways, and drives it in pieces, as long as they can be driven (J.-P. Laumond et al., "A motion planner for
/// nonholonomic mobile robots", 1994). Near a piece that cannot be driven the way is made dear, and another is tried.
class ShuffleSearch {
 public:
  /// @param area     the rear axle stays inside while searching.
  /// @param to_goal  of that area; must outlive the search.
  ShuffleSearch(const Scene& scene, const Query& query, const BoundingBox& area, const DistanceMap& to_goal);
  ShuffleSearch(const ShuffleSearch&) = delete;
  ShuffleSearch& operator=(const ShuffleSearch&) = delete;

  /// @param stop  asked after every step of the searches.
  /// @return whether a path was found. If not, there may be one all the same.
  bool run(const std::function<bool()>& stop);

  /// The path found by the last run, from start to goal.
  const Arcs& arcs() const { return arcs_; }

 private:
  std::size_t follow(const std::vector<Pose2d>& way);
  bool searchPiece(const std::vector<Pose2d>& way, std::size_t first, std::size_t last);

  Scene scene_;
  Query query_;
  BoundingBox area_;
  HolonomicSearch ways_;
  std::function<bool()> stop_;
  Arcs arcs_;
};

}  // namespace external_command
