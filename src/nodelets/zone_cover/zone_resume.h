// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "zone_plan_file.h"

namespace external_command {

/// What an earlier run has kept in its file, as far as it can be true of the zone and the vehicle.
/// @param dry_run  changes nothing; else a damaged file is kept aside.
/// @throws InvalidRequest  it has kept nothing, or the file is damaged; the text says how, and what to do.
/// @throws InternalError   the file cannot be read.
/// @throws Cancelled
CoverageProgress readProgress(const ZonePlanFile& file, const CoverageArea& zone, const CoverageParams& params,
                              const VehicleParams& vehicle, bool dry_run, const CancelToken& cancel = {});

/// Leaves lines that are not done for the end.
/// @throws InvalidRequest  one is not in the plan.
void addSkipped(const std::vector<std::uint32_t>& skip_swath, CoverageProgress* progress);

}  // namespace external_command
