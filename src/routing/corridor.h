// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "course_geometry.h"
#include "external_command/core/vehicle.h"
#include "path_fit.h"

namespace external_command {

/// Where a vehicle may be on a course: within the boundaries of its lanes.
class Corridor {
 public:
  Corridor(const HdMap& map, const VehicleParams& vehicle) : map_(map), vehicle_(vehicle) {}

  /// Sets the limits of `point`, whose base and normal are known, so that half the vehicle's width stays within the
  /// boundaries at `place`, and wishes for a margin to them; the centre line is always within the limits.
  void limit(const CoursePoint& place, FitPoint* point) const;

  /// From the centre line to the nearer boundary at `place` [m].
  double narrowest(const CoursePoint& place) const;

  /// What narrowest() is at least, all along `lane` [m]. O(n)
  double narrowestOf(LaneIndex lane) const;

  /// By how much the vehicle's front leaves the lane at `place` on the outer side of a bend of `kappa` [1/m] along the
  /// centre line; negative where there is room left [m].
  double frontExcess(const CoursePoint& place, double kappa) const;

 private:
  double neighbourWidth(const Lane& lane, double s, LaneChange side) const;

  const HdMap& map_;
  const VehicleParams& vehicle_;
};

}  // namespace external_command
