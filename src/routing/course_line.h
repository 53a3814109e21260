// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "route_rows.h"

namespace external_command {

/// A centre line, lanes one after the other, with the distance along it [m], the speed limit up to each point [m/s],
/// and the place on its lane. The route begins at s 0 and ends at `end`; the line goes on beyond both.
struct CourseLine {
  std::vector<Point2d> points;
  std::vector<double> s;
  std::vector<double> limits;
  std::vector<LanePoint> lanes;
  double end = 0.0;

  double leadIn() const { return -s.front(); }
  double leadOut() const { return s.back() - end; }
};

/// The line of a row, on which lanes whose ends do not meet are joined, and folds are left out.
/// @param lead_in, lead_out  by how much it goes on beyond the row, at most to the ends of its lanes [m].
CourseLine courseLine(const HdMap& map, const RouteRow& row, double lead_in, double lead_out, double default_limit);

}  // namespace external_command
