// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "external_command/Chassis.h"
#include "external_command/ros/command_gate.h"
#include "external_command/ros/command_registry.h"
#include "nodelets/chassis/pending_list.h"

namespace external_command {

/// Name of an action as in ActionCommand.msg, "PULL_OVER" for example; empty for a number that is none.
std::string nameOfAction(std::uint8_t action);

/// "FOLLOW (1), CHANGE_LEFT (2), ..."
std::string knownActions();

struct PendingActionParams {
  double timeout = 30.0;        ///< after which the end of an action is UNKNOWN [s]
  double stop_timeout = 120.0;  ///< the same of STOP and PULL_OVER [s]
  double moving_speed = 0.1;    ///< a faster vehicle moves [m/s]
  double clock_skew = 0.5;      ///< a report stamped this much before its action was sent still counts [s]
  /// Scenarios of the planner that show an action, by action.
  std::map<std::uint8_t, std::vector<std::string>> scenarios;

  /// With scenarios named like the actions, and those that ApolloAuto's planner has for STOP, PULL_OVER and FOLLOW.
  PendingActionParams();
};

/// The actions that were sent and have not ended, and what ends each:
///
///   FOLLOW, CHANGE_*, *_MISSION   a report of the planner, or a scenario that shows it
///   STOP, PULL_OVER               a scenario that shows it, and a report that it is finished
///   START                         a vehicle that was seen standing, or not at all, and then moves; one that moved all
///                                 the time, for it may have been braking: two seconds later
///   VIN_REQ                       a chassis that reports a vin
///
/// A motion command that is sent after a STOP or PULL_OVER supersedes it.
///
/// A report is about an action where it has the action's id or 0, for STOP and PULL_OVER also that of the running
/// motion command; those that are older than the action count for nothing. Each call returns the statuses that changed.
/// Not thread-safe.
class PendingActions {
 public:
  using Changes = std::vector<StatusChange>;

  explicit PendingActions(PendingActionParams params) : params_(std::move(params)) {}

  /// To be called right before the action is sent. Of STOP, PULL_OVER and START the newest counts: another that is
  /// still waited for is superseded.
  /// @param now  [s], of any steady clock.
  Changes add(const AdmittedCommand& command, std::uint8_t action, double now);

  /// @param motion  that is under way; may be nullptr.
  Changes onPlannerStatus(const CommandStatus& status, const SentMotion* motion);
  Changes onMotionSent(const AdmittedCommand& motion);
  Changes onScenario(const std::string& scenario);
  Changes onChassis(const Chassis& chassis);
  Changes onTime(double now);

  /// What is pending is waited for no longer: the processor is unloaded.
  Changes giveUp() { return endAll(&pending_); }

  bool empty() const { return pending_.empty(); }

  /// Waits no longer for those whose command was ended otherwise: for them `is_running` is false.
  void keepWhere(const std::function<bool(CommandSerial)>& is_running);

 private:
  struct Pending {
    AdmittedCommand command;
    std::uint8_t action = 0;
    double deadline = 0.0;     ///< [s]
    ros::Time sent_at;         ///< to compare with the stamps of reports
    bool is_reported = false;  ///< as finished
    bool was_standing = false;
  };

  bool isShown(const Pending& pending) const;
  std::optional<CommandStatus> endOfHold(const Pending& pending) const;
  std::optional<CommandStatus> afterReport(const CommandStatus& report, bool is_meant, Pending* pending) const;

  const PendingActionParams params_;
  std::vector<Pending> pending_;
  std::string scenario_;     ///< the planner's present one
  double now_ = 0.0;         ///< when it was told last [s]
  bool is_standing_ = true;  ///< the vehicle, as reported last; taken for granted before the first report
};

}  // namespace external_command
