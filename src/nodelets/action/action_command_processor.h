// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/steady_timer.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "external_command/Action.h"
#include "external_command/ActionCommand.h"
#include "external_command/Chassis.h"
#include "external_command/PlanningState.h"
#include "external_command/ros/service_command_processor.h"
#include "nodelets/chassis/heard_chassis.h"
#include "nodelets/chassis/mode_switch.h"
#include "pending_actions.h"

namespace external_command {

/// Single actions: stop, pull over, start, change lane, switch the driving mode ...
///
/// An action is sent at once, on the processor's executor, where nothing is ever waited for; what shows its end is
/// watched on a second executor.
class ActionCommandProcessor : public ServiceCommandProcessor<Action> {
 public:
  ActionCommandProcessor();
  ~ActionCommandProcessor() override;

 private:
  struct RunningSwitch {
    AdmittedCommand command;
    ModeSwitch decision;
  };

  void start() override;
  void readParameters();
  void subscribe();

  Threads threads() const override { return {1, ExecutorPriority::kUrgent}; }
  bool actsAlways(const ActionCommand& command) const override;
  void check(const ActionCommand& command) const override;
  CommandStatus execute(const ActionCommand& command, const AdmittedCommand& admitted, Response* response) override;

  CommandStatus sendAndWatch(const ActionCommand& command, const AdmittedCommand& admitted);
  CommandStatus clearPlanning(const AdmittedCommand& admitted);
  CommandStatus switchMode(const AdmittedCommand& admitted, ModeSwitch::Target target);

  /// Where one to auto is running.
  void endSwitchToAuto(const AdmittedCommand& stop, const char* name);

  /// Carries the running mode switch one step on; its status.
  StatusChange advanceSwitch();

  /// The same, and tells it, where a switch is running.
  void goOnSwitching();

  void onChassis(const Chassis& chassis);
  void onTick();
  void record(const PendingActions::Changes& changes);

  void sendToControl(std::uint8_t pad) const;

  ModeSwitchParams mode_switch_params_;
  ros::Publisher control_pad_;

  std::mutex mutex_;  ///< guards what follows; held for decisions and sending, never while waiting
  std::optional<PendingActions> pending_;
  std::optional<RunningSwitch> switch_;
  bool mode_is_settled_ = true;  ///< no mode is asked for that the chassis may still go into
  std::optional<HeardChassis> chassis_;
  std::atomic<bool> is_waiting_{false};  ///< there may be something pending, or a switch running

  Executor watch_executor_{
      ExecutorOptions{"the executor of the chassis"}};  // before its users: they leave its queue first
  std::vector<ros::Subscriber> subscribers_;
  Periodic timer_;
  boost::signals2::connection sent_motions_;
};

}  // namespace external_command
