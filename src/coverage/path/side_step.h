// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace external_command {

/// A shift sideways in two arcs that turn against each other, as tight as the vehicle turns: the quickest way forward
/// to a parallel line that is not farther away than two turning radii.
struct SideStep {
  /// @param shift   to either side [m].
  /// @param radius  of the arcs [m].
  SideStep(double shift, double radius);

  double along;  ///< distance ahead that it takes [m]
  double more;   ///< that is driven on top of it [m]
};

}  // namespace external_command
