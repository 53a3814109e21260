// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_params.h"

#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

void requireWithin(const char* key, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN
  throw InvalidParameter(text("coverage/", key, " is ", value, "; it must lie in [", low, ", ", high, "]"));
}

}  // namespace

void CoverageParams::validate() const {
  requireWithin("swath_width", swath_width, 0.1, 100.0);
  requireWithin("overlap", overlap, 0.0, swath_width / 2.0);
  requireWithin("margin", margin, 0.0, 5.0);
  requireWithin("headland_laps", headland_laps, -1, 50);
  if (swath_heading && !std::isfinite(*swath_heading)) throw InvalidParameter("coverage/swath_heading is not finite");
  requireWithin("target_coverage", target_coverage, 0.5, 1.0);
  requireWithin("max_gap", max_gap, 0.0, 1e6);
  requireWithin("gear_change_cost", gear_change_cost, 0.0, 1e3);
  requireWithin("spacing", spacing, 0.05, 100.0);
  requireWithin("max_grid_rows", static_cast<double>(max_grid_rows), 1, 1e7);
  requireWithin("time_budget", time_budget, 1e-3, 3600.0);
}

}  // namespace external_command
