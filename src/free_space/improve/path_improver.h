// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "free_space/driving_cost.h"
#include "free_space/random.h"
#include "free_space/stop_condition.h"
#include "track.h"

namespace external_command {

/// Makes a path cheaper by replacing pieces of it by Reeds-Shepp words: straight from place to place, or over a pose
/// near the path. Hill climbing with random steps of all sizes; the path keeps the margin at every moment.
class PathImprover {
 public:
  PathImprover(const Scene& scene, const DrivingCost& cost, const Query& query, std::uint64_t seed);

  /// @param arcs      a free path for the query.
  /// @param patience  ends after this many trials one after the other that win less than 0.1 % together.
  Arcs improve(const Arcs& arcs, std::size_t patience, WorkBudget* budget);

 private:
  std::optional<Arcs> tryOnce(const Track& track);
  WordQuery wordQuery(int gear, double kappa, const Track::Place& to, double budget) const;
  double costOf(const Pose2d& from, const SteeringWord& word) const;
  std::optional<Arcs> tryShortcut(const Track& track, const Track::Place& from, const Track::Place& to) const;
  std::optional<Arcs> tryVia(const Track& track, const Track::Place& from, const Pose2d& via,
                             const Track::Place& to) const;
  bool isDrivable(const Pose2d& from, const SteeringWord& word) const;

  Scene scene_;
  DrivingCost cost_;
  Query query_;
  Random random_;
};

}  // namespace external_command
