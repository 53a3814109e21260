// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "external_command/ros/motion_plan.h"
#include "external_command/ros/routing_task.h"

namespace external_command {

/// The part of MotionCommandProcessor that does not depend on the service.
class MotionFlow {
 public:
  MotionFlow(ProcessContext& context, const std::vector<std::string>& command_topics, const std::string& history_topic);

  /// @throws NoRoute  there is none. @throws InvalidRequest  it is longer than PathBounds allow.
  void requireRoute(const RoutingTask& task, const CancelToken& cancel) const { routeOf(task, cancel); }

  /// Searches the route and starts `plan` with its reference path.
  void addRoute(const RoutingTask& task, double target_speed, const CancelToken& cancel, MotionPlan* plan) const;

  /// Fills what is left of the path; its speeds are still caps.
  /// @throws InvalidRequest  the path is too large, or leads beyond what ContextParams::limits allow.
  /// @param begins_at_vehicle  the way to plan.start() is put in front of it.
  void assemble(double target_speed, bool begins_at_vehicle, const CancelToken& cancel, MotionPlan* plan) const;

  /// Makes the path begin where the vehicle is now, though it may have moved while the path was planned: what it has
  /// driven of it already is cut off.
  /// @param seen_at  where the vehicle was when the planning began.
  /// @return  false where it is not on the path.
  bool fitToVehicle(const Pose2d& seen_at, MotionPlan* plan) const;

  /// Tells of a path that is to be driven, and begins elsewhere than at the vehicle since the command says so.
  static void warnOfStart(const Pose2d& vehicle, MotionPlan* plan);

  /// Computes the speeds of the whole path, and fills what is left of command, report and scene from it.
  void complete(std::int64_t command_id, double target_speed, MotionPlan* plan) const;

  /// Sends the plan and shows it, unless a stop or a newer command came in between; ends the command it replaces.
  /// @throws Cancelled, Superseded
  void send(const CommandGate::Ticket& ticket, MotionPlan&& plan) const;

  /// How it stands with the planner. @throws NotReady  nobody listens, or it says nothing about what it should drive.
  std::string plannerWords() const;

  /// The vehicle's limit where `target_speed` exceeds it, with a warning in `report`.
  /// @throws InvalidRequest  it exceeds ContextParams::limits.
  double cappedSpeed(double target_speed, PlanReport* report) const;

 private:
  Route routeOf(const RoutingTask& task, const CancelToken& cancel) const;
  std::optional<Pose2d> startOnLane(const RoutingTask& task) const;

  ProcessContext& context_;
  MotionPublishers publishers_;
};

}  // namespace external_command
