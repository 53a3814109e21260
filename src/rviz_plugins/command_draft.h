// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Point.h>

#include <QString>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "external_command/MapObject.h"
#include "external_command/Pose.h"

namespace external_command {

class GatewayLink;

enum class CommandKind { kLaneFollow, kFreeSpace, kPreciseParking, kValetParking, kZoneCover, kPathFollow };

struct CommandKindWords {
  CommandKind kind;
  const char* name;   ///< of the service
  const char* words;  ///< for a person
};

/// In the order of CommandKind.
constexpr std::array<CommandKindWords, 6> kCommandKinds = {{
    {CommandKind::kLaneFollow, "lane_follow", "Lane follow"},
    {CommandKind::kFreeSpace, "free_space", "Free space"},
    {CommandKind::kPreciseParking, "precise_parking", "Precise parking"},
    {CommandKind::kValetParking, "valet_parking", "Valet parking"},
    {CommandKind::kZoneCover, "zone_cover", "Zone cover"},
    {CommandKind::kPathFollow, "path_follow", "Path follow"},
}};

/// A motion command that is being put together; all in the frame of the map [m, rad].
struct CommandDraft {
  CommandKind kind = CommandKind::kLaneFollow;
  std::optional<Pose> goal;
  std::vector<geometry_msgs::Point> points;  ///< way points; of path follow the path
  std::string object_id;                     ///< of the parking space, or the area
  bool is_nose_in = true;
  double swath_width = 0.0;   ///< [m]; 0: the gateway's
  bool is_resumed = false;    ///< of a zone
  double target_speed = 0.0;  ///< [m/s]; 0: not given

  bool needsGoal() const;
  bool needsHeading() const;        ///< of the goal
  std::uint8_t objectKind() const;  ///< a constant of MapObject; 0: it needs none
  bool takesPoints() const;

  /// What has still to be given, and how; empty: it can be sent.
  QString missing() const;

  /// @pre  nothing is missing.
  void send(bool is_dry_run, GatewayLink* gateway) const;
};

}  // namespace external_command
