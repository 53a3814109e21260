// SPDX-License-Identifier: Apache-2.0
#include "polygon_area.h"

namespace external_command {

double signedArea(const std::vector<Point2d>& ring) {
  double twice = 0.0;  // relative to the first point: UTM coordinates would eat the digits
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    twice += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  }
  return twice / 2.0;
}

}  // namespace external_command
