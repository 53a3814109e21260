// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace external_command {

/// A point seen from a curve.
struct FrenetPoint {
  double s = 0.0;         ///< arc length along the curve of its nearest point, in [0, length] [m]
  double l = 0.0;         ///< lateral offset, positive to the left of the curve [m]
  double distance = 0.0;  ///< to the nearest point of the curve; larger than |l| beyond the ends [m]
};

}  // namespace external_command
