// SPDX-License-Identifier: Apache-2.0
#include "side_step.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kRoom = 1e-3;  ///< for rounding: with less than there has to be, a car would go round in a loop [m]

}  // namespace

SideStep::SideStep(double shift, double radius) {
  const double turn = std::acos(std::clamp(1.0 - std::abs(shift) / (2.0 * radius), -1.0, 1.0));
  along = turn > 0.0 ? 2.0 * radius * std::sin(turn) + kRoom : 0.0;
  more = turn > 0.0 ? 2.0 * radius * turn + kRoom - along : 0.0;
}

}  // namespace external_command
