// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_params.h"

#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/parameter_range.h"

namespace external_command {

void CoverageParams::validate() const {
  requireParameter("coverage/swath_width", swath_width, 0.1, 100.0);
  requireParameter("coverage/overlap", overlap, 0.0, swath_width / 2.0);
  requireParameter("coverage/margin", margin, 0.0, 5.0);
  requireParameter("coverage/headland_laps", headland_laps, -1, 50);
  if (swath_heading && !std::isfinite(*swath_heading)) throw InvalidParameter("coverage/swath_heading is not finite");
  requireParameter("coverage/target_coverage", target_coverage, 0.5, 1.0);
  requireParameter("coverage/max_gap", max_gap, 0.0, 1e6);
  requireParameter("coverage/gear_change_cost", gear_change_cost, 0.0, 1e3);
  requireParameter("coverage/turn_speed", turn_speed, 0.0, 20.0);
  requireParameter("coverage/path_spacing", spacing, 0.05, 100.0);
  requireParameter("coverage/max_grid_rows", static_cast<double>(max_grid_rows), 1, 1e7);
  requireParameter("coverage/time_budget", time_budget, 1e-3, 3600.0);
}

}  // namespace external_command
