// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/error.h"

namespace external_command {

const char* toString(ErrorCode code) {
  switch (code) {
    case ErrorCode::kOk:
      return "OK";
    case ErrorCode::kInvalidRequest:
      return "INVALID_REQUEST";
    case ErrorCode::kStaleRequest:
      return "STALE_REQUEST";
    case ErrorCode::kDuplicateId:
      return "DUPLICATE_ID";
    case ErrorCode::kUnknownId:
      return "UNKNOWN_ID";
    case ErrorCode::kNotReady:
      return "NOT_READY";
    case ErrorCode::kOffMap:
      return "OFF_MAP";
    case ErrorCode::kNoRoute:
      return "NO_ROUTE";
    case ErrorCode::kStartBlocked:
      return "START_BLOCKED";
    case ErrorCode::kGoalBlocked:
      return "GOAL_BLOCKED";
    case ErrorCode::kNoPath:
      return "NO_PATH";
    case ErrorCode::kPlanningTimeout:
      return "PLANNING_TIMEOUT";
    case ErrorCode::kCancelled:
      return "CANCELLED";
    case ErrorCode::kSuperseded:
      return "SUPERSEDED";
    case ErrorCode::kRefusedByVehicle:
      return "REFUSED_BY_VEHICLE";
    case ErrorCode::kInternalError:
      return "INTERNAL_ERROR";
  }
  return "UNKNOWN_CODE";
}

}  // namespace external_command
