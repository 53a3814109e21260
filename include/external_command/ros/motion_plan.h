// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "external_command/PlanReport.h"
#include "external_command/PlanningCommand.h"
#include "external_command/ros/command_gate.h"
#include "external_command/ros/markers.h"
#include "external_command/ros/motion_watch.h"
#include "external_command/routing/router.h"

namespace external_command {

/// What a motion command has become so far.
struct MotionPlan {
  explicit MotionPlan(PlanStart plan_start) : start(std::move(plan_start)) {}

  PlanStart start;  ///< where it begins, if it begins at the vehicle
  std::optional<Route> route;
  Path path;  ///< the route's reference path, then the planned manoeuvre; speeds are caps until it is complete
  PlanningCommand command;  ///< what the planning module gets, but for the path; the headers are filled in at the end
  PlanReport report;
  CommandScene scene;  ///< what rviz shows

  std::ptrdiff_t index_shift = 0;  ///< SentMotion::index_shift

  /// Ends the planning of the vehicle's older commands: for a processor that takes over when it does, see
  /// MotionCommandProcessor::takesOver(). Does nothing in a dry run. May be called more than once.
  /// @throws Cancelled, Superseded  this one is to be planned no further.
  std::function<void()> take_over = [] {};

  /// Called once the command was really sent, in the thread that planned it: for what must not be kept, or replaced,
  /// for a command that is refused after all. Called in the order of sending; must be quick.
  std::function<void(const SentMotion&)> on_sent;
};

}  // namespace external_command
