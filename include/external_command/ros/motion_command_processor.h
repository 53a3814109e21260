// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "external_command/core/text.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/conversions.h"
#include "external_command/ros/motion_flow.h"
#include "external_command/ros/planning_pool.h"
#include "external_command/ros/plans_in_work.h"
#include "external_command/ros/routing_task.h"
#include "external_command/ros/service_command_processor.h"

namespace external_command {

/// A command that moves the vehicle: convert() -> route -> processSpecialCommand() -> one PlanningCommand.
///
/// A derived class must  implement check() and processSpecialCommand() or convert(), and call stopServing() in its
///                       destructor.
/// A derived class must  poll the cancel token in every long loop: a stop or a newer command raises it.
/// A derived class may   override planningTime(), isPlannedAtOnce(), beginsAtVehicle() and takesOver(), and set
///                       MotionPlan::on_sent.
/// The hooks that plan run on a planning thread, below normal priority, but for plans that are made at once, and for
/// convert() of a command that has to wait for such a thread; no lock is held. What takes a lock of the gate is left to
/// the service's own thread meanwhile: a stop must not wait for a thread of low priority.
template <class Service>
class MotionCommandProcessor : public ServiceCommandProcessor<Service> {
 public:
  using typename ServiceCommandProcessor<Service>::Command;
  using typename ServiceCommandProcessor<Service>::Response;

 protected:
  explicit MotionCommandProcessor(const std::string& service) : ServiceCommandProcessor<Service>(service) {}

  /// Start, way points, goal and black list on the lanes; nullopt where the command drives no lanes (the default).
  /// @param start  where the vehicle is taken to be.
  /// @throws InvalidRequest, NotReady, OffMap
  virtual std::optional<RoutingTask> convert(const Command& /*command*/, const PlanStart& /*start*/) {
    return std::nullopt;
  }

  /// Adds the command's own part: to `plan->command`, and a manoeuvre to `plan->path` by join(),
  /// its speeds as caps.
  /// @throws Error  the command is refused; nothing was sent.
  virtual void processSpecialCommand(const Command& /*command*/, const CancelToken& /*cancel*/, MotionPlan* /*plan*/) {}

  /// How long the planning may take; the plan then begins where the vehicle will be [s]. 0 for what is planned at once,
  /// or begins with a route, which the vehicle may well drive on meanwhile.
  virtual double planningTime(const Command& /*command*/, const Pose2d& /*vehicle*/) const { return 0.0; }

  /// True where the plan is only a matter of a route and its path. It is made on the service's own thread then: to hand
  /// it to a planning thread and back would take as long.
  virtual bool isPlannedAtOnce(const Command& /*command*/) const { return false; }

  /// True where processSpecialCommand() calls MotionPlan::take_over itself, once it has found that the command can be
  /// planned at all, and before what takes long: a command that is refused for its own faults then leaves an older one
  /// that is being planned alone. Otherwise that is ended before.
  virtual bool takesOver() const { return false; }

  /// False for a path that begins where the command says.
  virtual bool beginsAtVehicle(const Command& command) const { return !startIsGiven(command, 0); }

  /// For a processor that tries another route. From start() on.
  const MotionFlow& flow() const { return *flow_; }

  void start() override {
    ServiceCommandProcessor<Service>::start();
    std::string history = "planning_command_history";
    this->parameters().readName("planning_command_history_name", &history);
    flow_.emplace(this->context(), this->outputTopics("planning/command"), history);
    this->needs("planner", [this] { return flow_->plannerWords(); });
    this->needs("planning", [&context = this->context()] {
      context.planningPool().requireRoom(context.vehicleName(), PlanningPool::Kind::kCommand);
      return "commands are planned";
    });
  }

  void cancelWork() override { plans_in_work_.cancelForGood(); }

  CommandService::Threads threads() const override {
    return {this->context().planningPool().threadsPerService(), ExecutorPriority::kNormal};
  }

  CommandStatus execute(const Command& command, const AdmittedCommand& admitted, Response* response) final {
    using Planning = CommandGate::Planning;
    const CancelSource source;
    const PlansInWork::Entry entry(&plans_in_work_, source);
    const auto kind = command.dry_run ? Planning::Kind::kDryRun : Planning::Kind::kMotion;
    const Planning planning(&this->context().gate(), kind, admitted, source);
    this->context().registry().requireRunning(admitted);  // it may have been cancelled before the gate knew of it
    const auto slot = takeSlot(command, planning);
    try {
      return command.dry_run ? planDry(command, slot, planning.cancelToken(), response)
                             : planAndSend(command, planning, slot, response);
    } catch (const Cancelled&) {
      requireLoaded();
      if (!command.dry_run) this->context().gate().requireNewest(admitted);  // tells who cancelled it
      throw;
    }
  }

 private:
  PlanningPool::Slot takeSlot(const Command& command, const CommandGate::Planning& planning) {
    const auto kind = command.dry_run ? PlanningPool::Kind::kDryRun : PlanningPool::Kind::kCommand;
    bool has_begun = command.dry_run;
    return this->context().planningPool().take(this->context().vehicleName(), kind, [&] {
      requireLoaded();
      if (!command.dry_run) this->context().gate().requireNewest(planning.command());
      planning.cancelToken().throwIfCancelled();
      if (!has_begun) beginBeforeItsTurn(command, planning);
      has_begun = true;
    });
  }

  /// While a command waits, an older one of the vehicle must not be planned on, and sent. Only one that has a route may
  /// cancel it; where the vehicle is may have changed by the time of planning, so nothing of this is kept.
  void beginBeforeItsTurn(const Command& command, const CommandGate::Planning& planning) {
    const PlanStart here = this->context().motionWatch().startFor(0.0);
    const double horizon = horizonOf(command, here);
    const PlanStart start = horizon > 0.0 ? this->context().motionWatch().startFor(horizon) : here;
    if (const auto task = convert(command, start)) flow_->requireRoute(*task, planning.cancelToken());
    this->context().gate().begin(planning);
  }

  CommandStatus planDry(const Command& command, const PlanningPool::Slot& slot, const CancelToken& cancel,
                        Response* response) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    MotionPlan plan(this->context().motionWatch().startFor(0.0));
    runPlan(command, slot, [&] {
      const double speed = flow_->cappedSpeed(command.target_speed, &plan.report);
      if (const auto task = convert(command, plan.start)) flow_->addRoute(*task, speed, cancel, &plan);
      processSpecialCommand(command, cancel, &plan);
      flow_->assemble(speed, false, cancel, &plan);
      flow_->complete(command.command_id, speed, &plan);
    });
    takeReport(begin, &plan, response);
    response->path = toMsg(plan.path);
    response->path.header = plan.command.path.header;
    return makeStatus(command.command_id, CommandStatus::FINISHED, ErrorCode::kOk, "dry run: nothing was sent");
  }

  CommandStatus planAndSend(const Command& command, const CommandGate::Planning& planning,
                            const PlanningPool::Slot& slot, Response* response) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    std::optional<MotionPlan> plan;
    CommandGate::Ticket ticket;
    runPlan(command, slot, [&] { plan = planFromWhereItWillBe(command, planning, slot, &ticket); });
    takeReport(begin, &*plan, response);
    flow_->send(ticket, *std::move(plan));
    return makeStatus(command.command_id, CommandStatus::RUNNING, ErrorCode::kOk, "sent");
  }

  void runPlan(const Command& command, const PlanningPool::Slot& slot, const std::function<void()>& job) const {
    if (isPlannedAtOnce(command)) {
      job();
    } else {
      slot.run(job);
    }
  }

  /// A vehicle that drives on while its plan is made may be elsewhere when it is done: planned once more, then, from
  /// where the vehicle will be.
  MotionPlan planFromWhereItWillBe(const Command& command, const CommandGate::Planning& planning,
                                   const PlanningPool::Slot& slot, CommandGate::Ticket* ticket) {
    const CancelToken cancel = planning.cancelToken();
    const bool is_at_vehicle = beginsAtVehicle(command);
    double horizon = 0.0;
    for (int tries = 1;; ++tries) {
      const ros::SteadyTime try_begin = ros::SteadyTime::now();
      const PlanStart here = startFor(0.0, slot);
      if (tries == 1) horizon = horizonOf(command, here);
      MotionPlan plan(horizon > 0.0 ? startFor(horizon, slot) : here);
      const double speed = flow_->cappedSpeed(command.target_speed, &plan.report);
      // The route first, a matter of a millisecond: a command without one must not disturb what is being planned.
      if (const auto task = convert(command, plan.start)) flow_->addRoute(*task, speed, cancel, &plan);
      bool has_begun = false;
      plan.take_over = [&] {
        slot.runAtNormalPriority([&] { *ticket = this->context().gate().begin(planning); });
        has_begun = true;
      };
      if (!takesOver()) plan.take_over();
      processSpecialCommand(command, cancel, &plan);
      if (!has_begun) plan.take_over();
      flow_->assemble(speed, is_at_vehicle, cancel, &plan);
      if (is_at_vehicle && here.isKnown() && !flow_->fitToVehicle(here.pose(), &plan)) {
        const double took = (ros::SteadyTime::now() - try_begin).toSec();
        requireAnotherTry(tries, took);
        horizon = 2.0 * std::max(horizon, took);
        continue;
      }
      if (startIsGiven(command, 0) && here.isKnown()) MotionFlow::warnOfStart(here.pose(), &plan);
      flow_->complete(command.command_id, speed, &plan);
      plan.take_over = nullptr;
      return plan;
    }
  }

  PlanStart startFor(double horizon, const PlanningPool::Slot& slot) const {
    std::optional<PlanStart> start;
    slot.runAtNormalPriority([&] { start = this->context().motionWatch().startFor(horizon); });
    return *std::move(start);
  }

  double horizonOf(const Command& command, const PlanStart& here) const {
    return beginsAtVehicle(command) && here.isKnown() ? planningTime(command, here.pose()) : 0.0;
  }

  static void requireAnotherTry(int tries, double took) {
    if (tries < 2) return;
    throw PlanningTimeout(text("the vehicle drove on for the ", seconds(took),
                               " that the planning took, and is no longer where the path begins (~max_start_shift); "
                               "the running command goes on: send it again, or stop the vehicle first"));
  }

  static void takeReport(const ros::SteadyTime& begin, MotionPlan* plan, Response* response) {
    plan->report.planning_time = (ros::SteadyTime::now() - begin).toSec();
    response->report = std::move(plan->report);
  }

  void requireLoaded() const {
    if (plans_in_work_.areCancelled()) throw Cancelled("its processor was unloaded while it was being planned");
  }

  template <class Any>
  static auto startIsGiven(const Any& command, int) -> decltype(static_cast<bool>(command.is_start_pose_set)) {
    return command.is_start_pose_set;
  }
  template <class Any>
  static bool startIsGiven(const Any& /*command*/, long) {
    return false;
  }

  PlansInWork plans_in_work_;
  std::optional<MotionFlow> flow_;
};

}  // namespace external_command
