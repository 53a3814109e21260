// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace external_command {

/// Identity of one admitted command within this process; never given twice. Callers choose ids and use them again once
/// a command has ended, so an id only looks a command up: whatever keeps hold of a command keeps its serial.
using CommandSerial = std::uint64_t;

/// Position of a request in the order in which requests came in, of all services and topics of one vehicle. Later ones
/// have larger numbers.
using ArrivalNumber = std::uint64_t;

/// A request that was let in.
struct AdmittedCommand {
  CommandSerial serial = 0;
  std::int64_t id = 0;  ///< positive; what callers know the command by
  ArrivalNumber arrival = 0;
};

}  // namespace external_command
