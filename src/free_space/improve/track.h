// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "free_space/driving_cost.h"

namespace external_command {

/// A curve of arcs with running length and cost. Immutable.
class Track {
 public:
  /// @param arcs  not empty.
  Track(const Query& query, const Arcs& arcs, const DrivingCost& cost);

  /// A place on the track.
  struct Place {
    Pose2d pose;
    int gear;         ///< in which the vehicle gets here, or goes on
    double kappa;     ///< of the arc [1/m]
    double cost;      ///< up to here, that of closeness spread evenly over each arc [m]
    std::size_t arc;  ///< on which it lies
    double s;         ///< [m]
  };

  /// The place at `s`; at a joint that of the arc which ends there.
  Place arriving(double s) const;

  /// The place at `s`; at a joint that of the arc which begins there, with gear change and steering at the joint in its
  /// cost.
  Place leaving(double s) const;

  const Arcs& arcs() const { return arcs_; }
  double length() const { return s_.back(); }
  double cost() const { return costs_.back(); }

  /// The arcs with everything between the two places replaced by `middle`.
  Arcs spliced(const Place& from, const Arcs& middle, const Place& to) const;

 private:
  std::size_t arcAt(double s) const;
  Place placeAt(std::size_t arc, double s) const;

  Arcs arcs_;
  Junctions junctions_;
  std::vector<Pose2d> begins_;
  std::vector<double> s_;        ///< at the begin of each arc, and at the end
  std::vector<double> driving_;  ///< cost of each arc alone
  std::vector<double> costs_;    ///< at the begin of each arc, with gear change and steering there; and at the end
};

}  // namespace external_command
