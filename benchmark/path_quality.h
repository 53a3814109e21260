// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/path.h"
#include "external_command/core/vehicle.h"
#include "external_command/map/hd_map.h"

namespace external_command {

/// How well the paths of a map can be driven. Measured from the positions of the points alone, not from what they
/// state.
class PathQuality {
 public:
  PathQuality(const HdMap& map, const VehicleParams& vehicle) : map_(map), vehicle_(vehicle) {}

  /// @param path  its speeds are caps. @param told  whether it is known to bend more than the vehicle can.
  void add(Path path, bool told);

  std::size_t paths() const { return paths_; }
  double shareOverLimit() const;                          ///< of paths with a curvature above the vehicle's
  double shareUntold() const;                             ///< of paths with one that nobody was told of
  double largestKappa() const { return largest_kappa_; }  ///< [1/m]

  /// Of paths that a controller cannot rely on for another reason, see commandPathFault(); and what the first of them
  /// is.
  std::size_t faulty() const { return faulty_; }
  const std::string& firstFault() const { return first_fault_; }

  /// By which a corner of the footprint leaves every lane that runs along there, at most [m].
  double largestExcess() const { return largest_excess_; }

  /// The same of the reference point.
  double largestOffset() const { return largest_offset_; }

 private:
  double excessAt(const Point2d& point, double heading) const;

  const HdMap& map_;
  const VehicleParams& vehicle_;
  std::size_t paths_ = 0, over_limit_ = 0, untold_ = 0, faulty_ = 0;
  std::string first_fault_;
  double largest_kappa_ = 0.0, largest_excess_ = 0.0, largest_offset_ = 0.0;
};

}  // namespace external_command
