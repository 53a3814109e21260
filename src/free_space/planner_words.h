// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "external_command/core/pose.h"
#include "external_command/core/text.h"

namespace external_command {

/// "1.00 s", or "20 ms".
inline std::string budgetWords(double budget) {
  return budget < 0.1 ? text(std::lround(1e3 * budget), " ms") : seconds(budget);
}

/// The goals are numbered only where there are several.
inline std::string nameOf(std::size_t goal, const std::vector<Pose2d>& goals) {
  return goals.size() > 1 ? text("goal ", goal) : "the goal";
}

/// A short length [m], in millimetres where it is less than a centimetre.
inline std::string closely(double length) {
  return length < 0.01 ? text(std::round(1e4 * length) / 10.0, " mm") : metres(length);
}

}  // namespace external_command
