// SPDX-License-Identifier: Apache-2.0
#include "zone_resume.h"

#include <string>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

CoverageProgress readProgress(const ZonePlanFile& file, const CoverageArea& zone, const CoverageParams& params,
                              const VehicleParams& vehicle, bool dry_run, const CancelToken& cancel) {
  std::string damage;
  try {
    if (auto progress = file.read()) {
      requirePlausible(*progress, zone.outer, vehicle, params, cancel);
      return *std::move(progress);
    }
  } catch (const InvalidRequest& error) {
    damage = error.what();
  }
  if (!damage.empty()) {
    if (!dry_run) file.setAside();
    throw InvalidRequest(text("resume: the file of the earlier run, ", file.path(), ", is damaged: ", damage,
                              dry_run ? "" : text("; it is kept aside as ", file.damagedPath()),
                              "; send the command without resume to begin anew"));
  }
  throw InvalidRequest(text("resume: no earlier run of this zone is known (", file.path(), ")",
                            file.isSetAside() ? text(", but a damaged file, ", file.damagedPath()) : std::string(),
                            "; send the command without resume"));
}

void addSkipped(const std::vector<std::uint32_t>& skip_swath, CoverageProgress* progress) {
  const std::size_t total = progress->lines.size();
  std::vector<bool> skipped(total, false);
  for (const std::size_t index : progress->skipped) skipped[index] = true;
  for (const std::size_t index : skip_swath) {
    if (index >= total) {
      throw InvalidRequest(
          text("skip_swath ", index, " is not in the plan; its swaths, laps among them, are 0 to ", total - 1));
    }
    if (skipped[index] || progress->isDone(index)) continue;
    skipped[index] = true;
    progress->skipped.push_back(index);
  }
}

}  // namespace external_command
