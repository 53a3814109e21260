// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

#include "external_command/CommandStatus.h"
#include "external_command/core/error.h"

namespace external_command {

/// A message as statuses have it: fit to be shown, and of 2,000 bytes at most.
std::string statusMessage(const std::string& message);

/// A status stamped now. `status` is one of CommandStatus's RUNNING, FINISHED, ERROR, UNKNOWN.
CommandStatus makeStatus(std::int64_t command_id, std::uint8_t status, ErrorCode code, const std::string& message);

/// What `error` means for a command. The one place where exceptions become statuses.
CommandStatus statusFrom(const std::exception_ptr& error, std::int64_t command_id);

/// How `report`, of a planner, ends a command: with its message and error code, fit to be passed on. A code that is
/// none of CommandStatus's becomes REFUSED_BY_VEHICLE, and is told in the message.
/// @pre  report.status is FINISHED or ERROR.
CommandStatus endFromReport(std::int64_t command_id, const CommandStatus& report);

/// True where a report with `stamp` was made before `sent_at`, but for clocks that differ by `skew` [s]. A report
/// without a stamp is as new as it is; where simulated time was set back since, stamps cannot be compared, and all
/// count.
bool isOlder(const ros::Time& stamp, const ros::Time& sent_at, double skew);

/// True where the command has come to its end: FINISHED or ERROR, or UNKNOWN after a timeout.
bool hasEnded(const CommandStatus& status);

}  // namespace external_command
