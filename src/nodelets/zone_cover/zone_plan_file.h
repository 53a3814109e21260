// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "external_command/coverage/coverage_planner.h"

namespace external_command {

/// What a zone's file is known by.
struct ZoneKey {
  std::string name;          ///< for people: whose zone it is, and which
  std::uint64_t digest = 0;  ///< equal for the same vehicle sweeping the same area with the same parameters
};

/// @param vehicle_namespace  of ROS: two vehicles never share a zone's file.
/// @param label              the area's id; empty for a polygon of the command.
ZoneKey zoneKey(const std::string& vehicle_namespace, const std::string& label, const CoverageArea& area,
                const CoverageParams& params, const VehicleParams& vehicle);

/// The folder that `~progress_folder` means: "~" at its front is the home folder, empty is `external_command` in the
/// folder of ROS, $ROS_HOME or else ~/.ros.
std::string zoneFolder(const std::string& parameter);

/// The file in which the plan for a zone, and how far it has come, is kept, so that a restarted node can go on: in the
/// format of zone_text.h. One file for each zone of each vehicle: NAMESPACE-AREA-DIGEST.zone.
class ZonePlanFile {
 public:
  /// @param folder  of zoneFolder().
  ZonePlanFile(const std::string& folder, const ZoneKey& key);

  const std::string& path() const { return path_; }
  std::uint64_t digest() const { return digest_; }

  /// nullopt where nothing is kept for the zone.
  /// @throws InvalidRequest  the file is damaged; the text says how.
  /// @throws InternalError   it cannot be read.
  std::optional<CoverageProgress> read() const;

  /// Where a damaged file is kept aside.
  std::string damagedPath() const { return path_ + ".damaged"; }
  void setAside() const;
  bool isSetAside() const;

  /// A name beside the file, another one each time, for what is to replace it.
  std::string temporaryPath() const;

 private:
  std::string path_;
  std::uint64_t digest_;
};

/// Removes what processes that were killed have left of temporary files of a vehicle's zones. To be called while this
/// process writes none.
void removeLeftovers(const std::string& folder, const std::string& vehicle_namespace);

}  // namespace external_command
