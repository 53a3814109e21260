// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "external_command/CommandStatus.h"

namespace external_command {

/// The name of a constant of CommandStatus::status, as it stands there; of any other value UNKNOWN.
inline const char* statusName(std::uint8_t status) {
  switch (status) {
    case CommandStatus::RUNNING:
      return "RUNNING";
    case CommandStatus::FINISHED:
      return "FINISHED";
    case CommandStatus::ERROR:
      return "ERROR";
    default:
      return "UNKNOWN";
  }
}

}  // namespace external_command
