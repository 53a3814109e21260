// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "coverage/path/curve.h"

namespace external_command {

/// A stretch of a lap along one side of the border, bent no more than the vehicle can, free from end to end.
struct Side {
  Curve curve;
  double length = 0.0;
};

/// Where a lap turns from one side to the next.
struct Corner {
  Pose2d middle;      ///< half-way round, on the line that the lap is to keep to
  double turn = 0.0;  ///< in all; positive to the left, which is away from the border [rad]
};

/// How to get from one side to the next, working.
struct CornerWay {
  double leave = 0.0;  ///< where it leaves the first side [m from its start]
  double enter = 0.0;  ///< where it enters the second [m from its start]
  Curve curve;         ///< from there to there
  bool fills = false;  ///< then backs up to the start of the second side, which is driven from there
  double cost = 0.0;   ///< length less the price of what it sweeps [m]
};

/// Finds the way round a corner that is the best bargain of length and swept area: forward curves that leave the first
/// side and enter the second at various distances; round an edge of the border also curves that swing out first; and
/// each of them with or without backing up into the corner.
class CornerSearch {
 public:
  /// @param price   of a square metre that is not swept [m/m^2].
  /// @param slants  whether it also looks for ways that turn farther inside, where the nose has room to swing out, and
  ///                come near the border in a long slant.
  CornerSearch(const Field& field, CoverageGrid* grid, double price, bool slants);

  std::optional<CornerWay> find(const Side& before, const Corner& corner, const Side& after);

 private:
  /// A place on a side.
  struct Place {
    double s = 0.0;  ///< from the side's start [m]
    Pose2d pose;
  };

  std::vector<Place> places(const Side& side, bool at_end) const;
  void tryDirect();
  void trySwing(const Corner& corner);
  void tryThrough(const Pose2d& apex);
  std::vector<Pose2d> apexes(const Corner& corner) const;
  void tryCurve(double leave, double enter, const Curve& curve);
  double costOf(const std::vector<Curve>& curves);

  const Field& field_;
  CoverageGrid& grid_;
  double price_;
  bool slants_;
  double own_share_;
  Side before_;  ///< the end of the first side, as far back as the search goes
  Side after_;   ///< the beginning of the second
  std::vector<Place> leaves_;
  std::vector<Place> enters_;
  std::optional<CornerWay> best_;
};

}  // namespace external_command
