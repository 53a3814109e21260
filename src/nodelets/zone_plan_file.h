// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "external_command/coverage/coverage_planner.h"

namespace external_command {

/// The plan for a zone and how far it has come, kept in a small text file so that a restarted node can go on. One file
/// per zone in a folder; a zone is what was asked to be swept, by `zoneKey`.
class ZonePlanFile {
 public:
  /// @param folder  is made where it is missing; "~" at its front is the home folder.
  ZonePlanFile(const std::string& folder, std::uint64_t zone_key);

  /// nullopt where nothing is kept for the zone, or the file is damaged.
  std::optional<CoverageProgress> read() const;

  /// Replaces the file as a whole, so that a crash leaves the old or the new one.
  /// @throws InternalError  it cannot be written; the text names the file.
  void write(const CoverageProgress& progress) const;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Equal for the same area swept with the same parameters by the same vehicle.
std::uint64_t zoneKey(const CoverageArea& area, const CoverageParams& params, const VehicleParams& vehicle);

}  // namespace external_command
