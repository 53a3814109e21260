// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/status.h"

#include <ros/time.h>

#include "external_command/core/printable.h"
#include "external_command/core/text.h"

namespace external_command {

std::string statusMessage(const std::string& message) {
  constexpr std::size_t kMost = 2000;  // [bytes]; a thousand of them are kept
  return printable(message, kMost);
}

CommandStatus makeStatus(std::int64_t command_id, std::uint8_t status, ErrorCode code, const std::string& message) {
  CommandStatus made;
  made.header.stamp = ros::Time::now();
  made.command_id = command_id;
  made.status = status;
  made.error_code = static_cast<std::uint16_t>(code);
  made.message = statusMessage(message);
  return made;
}

CommandStatus statusFrom(const std::exception_ptr& error, std::int64_t command_id) {
  try {
    std::rethrow_exception(error);
  } catch (const Error& known) {
    return makeStatus(command_id, CommandStatus::ERROR, known.code(), known.what());
  } catch (const std::exception& unknown) {
    return makeStatus(command_id, CommandStatus::ERROR, ErrorCode::kInternalError, unknown.what());
  } catch (...) {
    return makeStatus(command_id, CommandStatus::ERROR, ErrorCode::kInternalError, "an exception of unknown type");
  }
}

CommandStatus endFromReport(std::int64_t command_id, const CommandStatus& report) {
  if (report.status == CommandStatus::FINISHED) {
    return makeStatus(command_id, CommandStatus::FINISHED, ErrorCode::kOk, report.message);
  }
  const bool is_known = report.error_code <= CommandStatus::INTERNAL_ERROR;
  const bool tells_why = is_known && report.error_code != CommandStatus::OK;
  const ErrorCode code = tells_why ? static_cast<ErrorCode>(report.error_code) : ErrorCode::kRefusedByVehicle;
  const std::string own_code = text("the planner's error_code is ", report.error_code);
  const std::string message = report.message.empty() ? own_code : text(own_code, ": ", report.message);
  return makeStatus(command_id, CommandStatus::ERROR, code, is_known ? report.message : message);
}

bool isOlder(const ros::Time& stamp, const ros::Time& sent_at, double skew) {
  if (stamp.isZero() || ros::Time::now() < sent_at) return false;
  return stamp.toSec() < sent_at.toSec() - skew;  // a ros::Duration holds 68 years only
}

bool hasEnded(const CommandStatus& status) { return status.status != CommandStatus::RUNNING; }

}  // namespace external_command
