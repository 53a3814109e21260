// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coverage/field/field.h"
#include "curve.h"

namespace external_command {

/// A way to a line, with the end of the line before it and the begin of that line.
struct GradualLink {
  Curve curve;
  double before = 0.0;  ///< of it on the line before [m]
  double after = 0.0;   ///< of it on the line that it leads to [m]
};

/// The way `link` with its jumps of curvature made ramps that CoverageParams::turn_speed allows, as far as there is
/// room; see withSteeringRamps(). The lines at its ends are bent for that by centimetres, so that the way grows no
/// longer.
/// @param before  the line that `link` leads away from; nullptr: the vehicle stands there.
/// @param after   the line that it leads to.
GradualLink gradualLink(const Field& field, const Curve* before, const Curve& link, const Curve& after);

}  // namespace external_command
