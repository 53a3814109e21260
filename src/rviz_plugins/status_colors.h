// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "external_command/CommandStatus.h"

namespace external_command {

/// Of words on a light ground, for HTML.
inline const char* statusColor(std::uint8_t status) {
  switch (status) {
    case CommandStatus::RUNNING:
      return "#1565c0";
    case CommandStatus::FINISHED:
      return "#2e7d32";
    case CommandStatus::ERROR:
      return "#c62828";
    default:
      return "#6d6d6d";
  }
}

}  // namespace external_command
