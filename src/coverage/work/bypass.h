// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "coverage/field/profile.h"

namespace external_command {

/// Where a line is blocked, as columns of a profile, and what it takes to pass there beside it.
struct Bypass {
  int end = 0;         ///< one past the last column that is blocked
  double shift = 0.0;  ///< sideways, positive to the left [m]
  double more = 0.0;   ///< that is driven for it [m]
  double left = 0.0;   ///< area that stays unswept on the other side [m^2]
};

/// A coarse look at ways past small obstacles, by the cells that are kOpen and kPassable in `grid`.
class BypassSearch {
 public:
  BypassSearch(const Field& field, const CoverageGrid& grid) : field_(field), grid_(grid) {}

  /// Past what blocks the line `across` [m] at `column`, the first that is; nullopt if there is no way.
  std::optional<Bypass> find(const Profile& profile, double across, int column) const;

  bool isOpen(const Profile& profile, double across, int column) const { return is(kOpen, profile, across, column); }

 private:
  bool is(CellFlag flag, const Profile& profile, double across, int column) const {
    return (grid_.at(profile.point((column + 0.5) * profile.bin(), across)) & flag) != 0;
  }

  std::optional<double> shiftPast(const Profile& profile, double across, int begin, int end) const;
  double areaLeft(const Profile& profile, double across, const Bypass& bypass, int begin, double bend) const;

  const Field& field_;
  const CoverageGrid& grid_;
};

}  // namespace external_command
