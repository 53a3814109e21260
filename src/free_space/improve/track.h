// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "free_space/manoeuvre.h"

namespace external_command {

/// A curve of arcs with running length and cost. Immutable.
class Track {
 public:
  /// @param arcs  not empty.
  Track(const Query& query, const Arcs& arcs, const CostModel& cost);

  /// A place on the track.
  struct Place {
    Pose2d pose;
    int gear;         ///< in which the vehicle gets here, or goes on
    double cost;      ///< up to here [m]
    std::size_t arc;  ///< on which it lies
    double s;         ///< [m]
  };

  /// The place at `s`; at a joint that of the arc which ends there.
  Place arriving(double s) const;

  /// The place at `s`; at a joint that of the arc which begins there, with the gear change at the joint in its cost.
  Place leaving(double s) const;

  const Arcs& arcs() const { return arcs_; }
  double length() const { return s_.back(); }
  double cost() const { return total_cost_; }

  /// The arcs with everything between the two places replaced by `middle`.
  Arcs spliced(const Place& from, const Arcs& middle, const Place& to) const;

 private:
  std::size_t arcAt(double s) const;
  Place placeAt(std::size_t arc, double s) const;

  CostModel cost_model_;
  Arcs arcs_;
  int gear_after_;
  std::vector<Pose2d> begins_;
  std::vector<double> s_;      ///< at the begin of each arc, and at the end
  std::vector<double> costs_;  ///< at the begin of each arc, with the gear change there
  double total_cost_;
};

}  // namespace external_command
