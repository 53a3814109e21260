// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "curve.h"

namespace external_command {

/// Something to be worked on in one go, and the ways in which that can be done: a swath from either end, a closed lap
/// from any of several places. All of them sweep about the same area.
struct Work {
  std::vector<Curve> ways;
  int lap = -1;          ///< of a lap: 0 is the outermost; -1 of a swath
  bool is_ring = false;  ///< a lap that is not along the border: around a hole, or in a part of its own
};

}  // namespace external_command
