// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <cstdint>
#include <optional>
#include <string>

#include "external_command/Chassis.h"
#include "external_command/CommandStatus.h"
#include "external_command/Readiness.h"

namespace external_command {

/// What is known of a gateway and its vehicle.
struct GatewayState {
  bool is_found = false;                ///< its services can be reached
  std::optional<Chassis> chassis;       ///< nullopt: none that is new
  std::optional<Readiness> readiness;   ///< nullopt: it has told none
  std::optional<CommandStatus> motion;  ///< of the motion command that is driven, or was last
};

/// What came of a command, or how it has ended.
struct Answer {
  std::string vehicle;  ///< its namespace
  std::string service;  ///< lane_follow, action, ...; empty: not known
  QString what = {};    ///< for a person: "lane follow, dry run", "STOP"
  std::int64_t command_id = 0;
  std::optional<std::uint8_t> status = std::nullopt;  ///< of CommandStatus; nullopt: there was no answer
  std::uint16_t code = 0;                             ///< of CommandStatus
  QString words = {};                                 ///< the gateway's; why there was no answer
};

}  // namespace external_command
