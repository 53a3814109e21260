// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "curve.h"
#include "field.h"
#include "grid.h"

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
  /// @param price  of a square metre that is not swept [m/m^2].
  CornerSearch(const Field& field, CoverageGrid* grid, double price) : field_(field), grid_(*grid), price_(price) {}

  std::optional<CornerWay> find(const Side& before, const Corner& corner, const Side& after);

 private:
  void tryCurve(const Side& before, const Side& after, double leave, double enter, const Curve& curve);
  void tryDirect(const Side& before, const Side& after);
  void trySwing(const Side& before, const Corner& corner, const Side& after);
  std::vector<Pose2d> apexes(const Corner& corner) const;
  double costOf(const Side& before, const Side& after, const CornerWay& way);

  const Field& field_;
  CoverageGrid& grid_;
  double price_;
  double first_reach_ = 0.0;   ///< how far back on the first side the search goes [m]
  double second_reach_ = 0.0;  ///< how far on, on the second [m]
  std::optional<CornerWay> best_;
};

}  // namespace external_command
