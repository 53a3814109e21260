// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "external_command/PlanReport.h"
#include "external_command/PlanningCommand.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/conversions.h"
#include "external_command/ros/routing_task.h"
#include "external_command/ros/service_command_processor.h"

namespace external_command {

/// What a motion command has become so far.
struct MotionPlan {
  std::optional<Route> route;
  Path path;                ///< the route's reference path, then the planned manoeuvre
  PlanningCommand command;  ///< what the planning module gets; path and header are filled in at the end
  PlanReport report;
  CommandScene scene;  ///< what rviz shows
};

/// @throws NotReady  `dry_runs` are more than `limit`; none waits, so that each answer comes within the planning
///                   budget.
void requireNotMore(std::size_t dry_runs, std::size_t limit);

/// The part of MotionCommandProcessor that does not depend on the service.
class MotionFlow {
 public:
  MotionFlow(ProcessContext& context, const std::vector<std::string>& command_topics, const std::string& history_topic);

  /// Searches the route and starts `plan` with its reference path.
  void addRoute(const RoutingTask& task, double target_speed, const CancelToken& cancel, MotionPlan* plan) const;

  /// Fills what is left of command, report and scene from the path.
  void complete(std::int64_t command_id, double target_speed, MotionPlan* plan) const;

  /// Sends the plan and shows it, unless a stop or a newer command came in between; ends the command it replaces.
  /// @throws Cancelled, Superseded
  void send(const CommandGate::Ticket& ticket, MotionPlan&& plan) const;

  /// The vehicle's limit where `target_speed` exceeds it, with a warning in `report`.
  double cappedSpeed(double target_speed, PlanReport* report) const;

 private:
  ProcessContext& context_;
  std::vector<ros::Publisher> command_publishers_;
  ros::Publisher history_publisher_, routing_publisher_;
};

/// A command that moves the vehicle: convert() -> route -> processSpecialCommand() -> one PlanningCommand.
///
/// A derived class must  implement check() and processSpecialCommand() or convert(), and call stopServing() in its
///                       destructor.
/// A derived class must poll the cancel token in every long loop: a stop or a newer command raises it.
/// All hooks run on the processor's lane; no lock is held.
template <class Service>
class MotionCommandProcessor : public ServiceCommandProcessor<Service> {
 public:
  using typename ServiceCommandProcessor<Service>::Command;
  using typename ServiceCommandProcessor<Service>::Response;

 protected:
  /// The newer request must get through while the older one is being planned, and cancels it; and both while as many
  /// dry runs as may be are in work.
  explicit MotionCommandProcessor(const std::string& service)
      : ServiceCommandProcessor<Service>(service, kMaxDryRuns + 2) {}

  /// Start, way points, goal and black list on the lanes; nullopt where the command drives no lanes (the default).
  /// @throws InvalidRequest, NotReady, OffMap
  virtual std::optional<RoutingTask> convert(const Command& /*command*/) { return std::nullopt; }

  /// Adds the command's own part: to `plan->command`, and a manoeuvre to `plan->path` by join().
  /// @throws Error  the command is refused; nothing was sent.
  virtual void processSpecialCommand(const Command& /*command*/, const CancelToken& /*cancel*/, MotionPlan* /*plan*/) {}

  void start() override {
    ServiceCommandProcessor<Service>::start();
    std::string history = "planning_command_history";
    this->parameters().readName("planning_command_history_name", &history);
    flow_.emplace(this->context(), this->outputTopics("planning/command"), history);
  }

  CommandStatus execute(const Command& command, const CommandGate::Arrival& arrival, Response* response) final {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    MotionPlan plan;
    const double speed = flow_->cappedSpeed(command.target_speed, &plan.report);
    if (const auto task = convert(command)) flow_->addRoute(*task, speed, CancelToken(), &plan);

    // A dry run must not cancel what is being planned for real, so it takes no ticket.
    std::optional<CommandGate::Ticket> ticket;
    if (!command.dry_run) ticket = this->context().gate().begin(command.command_id, arrival);
    const CancelSource planning = ticket ? ticket->cancelSource() : CancelSource();
    PlansInWork& in_work = ticket ? this->plansInWork() : this->dryRunsInWork();
    const PlansInWork::Entry entry(&in_work, planning);
    if (!ticket) requireNotMore(in_work.size(), kMaxDryRuns);
    try {
      processSpecialCommand(command, planning.token(), &plan);
    } catch (const Cancelled&) {
      // Who cancelled it?
      if (ticket) this->context().gate().requireCurrent(*ticket);
      if (in_work.areCancelled()) throw Cancelled("its processor was unloaded while it was being planned");
      throw;
    }
    flow_->complete(command.command_id, speed, &plan);
    plan.report.planning_time = (ros::SteadyTime::now() - begin).toSec();
    response->report = std::move(plan.report);
    if (!ticket) {
      response->path = std::move(plan.command.path);
      return makeStatus(command.command_id, CommandStatus::FINISHED, ErrorCode::kOk, "dry run: nothing was sent");
    }
    flow_->send(*ticket, std::move(plan));
    return makeStatus(command.command_id, CommandStatus::RUNNING, ErrorCode::kOk, "sent");
  }

 private:
  static constexpr unsigned kMaxDryRuns = 6;

  std::optional<MotionFlow> flow_;
};

}  // namespace external_command
