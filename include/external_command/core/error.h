// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace external_command {

/// Why a command was not carried out. The numbers equal the constants of `CommandStatus.msg`.
///
///   Error
///    +- InvalidRequest      1   the request itself is wrong: the text names field, value and what was expected
///    +- StaleRequest        2   its stamp is too old
///    +- DuplicateId         3   another command with this id is still running
///    +- UnknownId           4   no command with this id was ever seen
///    +- NotReady            5   map, vehicle pose or chassis is not there yet: the text names what is missing
///    +- OffMap              6   a pose lies too far from every lane that may be driven
///    +- NoRoute             7   the lanes exist, no route connects them
///    +- StartBlocked        8   the footprint collides, or lies outside the region, at the start
///    +- GoalBlocked         9   the same at the goal
///    +- NoPath             10   no drivable path was found
///    +- PlanningTimeout    11   the planning budget ran out
///    +- Cancelled          12   the cancel token was raised
///    +- Superseded         13   a newer motion command took over
///    +- RefusedByVehicle   14   planner or chassis reported a failure
///    +- InternalError      15   a bug, or the environment failed us
///        +- InvalidParameter    a parameter is out of range: the text names key, value and range
///        +- MapError            a map file cannot be used
enum class ErrorCode : std::uint16_t {
  kOk = 0,
  kInvalidRequest = 1,
  kStaleRequest = 2,
  kDuplicateId = 3,
  kUnknownId = 4,
  kNotReady = 5,
  kOffMap = 6,
  kNoRoute = 7,
  kStartBlocked = 8,
  kGoalBlocked = 9,
  kNoPath = 10,
  kPlanningTimeout = 11,
  kCancelled = 12,
  kSuperseded = 13,
  kRefusedByVehicle = 14,
  kInternalError = 15,
};

/// The name as in `CommandStatus.msg`, "NO_ROUTE" for example.
const char* toString(ErrorCode code);

/// Base of everything this package throws on purpose. The text is for a person: what, where, how much, what next.
class Error : public std::runtime_error {
 public:
  ErrorCode code() const { return code_; }

 protected:
  Error(ErrorCode code, const std::string& what) : std::runtime_error(what), code_(code) {}

 private:
  ErrorCode code_;
};

/// An Error whose type fixes its code, so that the two cannot disagree.
template <ErrorCode kCode>
class ErrorOf : public Error {
 public:
  explicit ErrorOf(const std::string& what) : Error(kCode, what) {}
};

using InvalidRequest = ErrorOf<ErrorCode::kInvalidRequest>;
using StaleRequest = ErrorOf<ErrorCode::kStaleRequest>;
using DuplicateId = ErrorOf<ErrorCode::kDuplicateId>;
using UnknownId = ErrorOf<ErrorCode::kUnknownId>;
using NotReady = ErrorOf<ErrorCode::kNotReady>;
using OffMap = ErrorOf<ErrorCode::kOffMap>;
using NoRoute = ErrorOf<ErrorCode::kNoRoute>;
using StartBlocked = ErrorOf<ErrorCode::kStartBlocked>;
using GoalBlocked = ErrorOf<ErrorCode::kGoalBlocked>;
using NoPath = ErrorOf<ErrorCode::kNoPath>;
using PlanningTimeout = ErrorOf<ErrorCode::kPlanningTimeout>;
using Cancelled = ErrorOf<ErrorCode::kCancelled>;
using Superseded = ErrorOf<ErrorCode::kSuperseded>;
using RefusedByVehicle = ErrorOf<ErrorCode::kRefusedByVehicle>;
using InternalError = ErrorOf<ErrorCode::kInternalError>;

/// A parameter of the wrong type or out of range; stops the start.
class InvalidParameter : public InternalError {
 public:
  using InternalError::InternalError;
};

/// A map file that cannot be used: missing, empty, truncated, not a map, no lane in it.
class MapError : public InternalError {
 public:
  using InternalError::InternalError;
};

}  // namespace external_command
