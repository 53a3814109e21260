// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>

#include "search_tree.h"

namespace external_command {

/// Hybrid A* from both ends at once, so that the tighter end, wherever it lies, is searched from the inside out. Each
/// end begins coarsely and goes on more finely when its tree is exhausted.
class TwoWaySearch {
 public:
  enum class Outcome {
    kFound,
    kNone,        ///< one end was searched through at the finest level: there is no path
    kStopped,     ///< by the caller
    kOutOfSteps,  ///< max_steps, or the memory bound of the finest level
  };

  struct Limits {
    std::size_t max_steps;                                      ///< nodes taken from the queues of both ends
    double max_cost = std::numeric_limits<double>::infinity();  ///< dearer paths are not looked for [m]
    std::function<bool()> stop;                                 ///< asked after every step
  };

  /// How a repeated search differs from the first one, so that it may find another path.
  struct Variant {
    std::size_t first_level = 0;
    double weight = 1.5;         ///< see SearchLevel
    double stride_factor = 1.0;  ///< longer or shorter steps
    double shift = 0.0;          ///< see SearchLevel
  };

  /// @param area  the rear axle stays inside while searching.
  TwoWaySearch(const Scene& scene, const Query& query, const BoundingBox& area);
  TwoWaySearch(const TwoWaySearch&) = delete;
  TwoWaySearch& operator=(const TwoWaySearch&) = delete;

  const DistanceMap& toStart() const { return to_start_; }
  const DistanceMap& toGoal() const { return to_goal_; }

  Outcome run(const Variant& variant, const Limits& limits);

  /// The path found by the last run, from start to goal.
  const Arcs& arcs() const { return arcs_; }

  /// The finest level that one of the ends had come to when the last run ended: high where that end is in a tight
  /// place, low where the tight place lies between them.
  std::size_t finestLevel() const { return std::max(levels_[0], levels_[1]); }

 private:
  std::size_t sideOf(std::size_t step) const;
  SearchLevel levelFor(std::size_t i, const Variant& variant) const;
  void keep(const Connection& connection, bool from_start);

  Scene scene_;
  Scene backward_scene_;
  DistanceMap to_goal_;
  DistanceMap to_start_;
  SearchTree from_start_;
  SearchTree from_goal_;
  std::array<std::size_t, 2> levels_{};  ///< of the two trees
  Arcs arcs_;
};

}  // namespace external_command
