// SPDX-License-Identifier: Apache-2.0
#include "pending_actions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "external_command/ActionCommand.h"
#include "external_command/core/text.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

constexpr std::pair<std::uint8_t, const char*> kActions[] = {
    {ActionCommand::FOLLOW, "FOLLOW"},
    {ActionCommand::CHANGE_LEFT, "CHANGE_LEFT"},
    {ActionCommand::CHANGE_RIGHT, "CHANGE_RIGHT"},
    {ActionCommand::PULL_OVER, "PULL_OVER"},
    {ActionCommand::STOP, "STOP"},
    {ActionCommand::START, "START"},
    {ActionCommand::CLEAR_PLANNING, "CLEAR_PLANNING"},
    {ActionCommand::SWITCH_TO_MANUAL, "SWITCH_TO_MANUAL"},
    {ActionCommand::SWITCH_TO_AUTO, "SWITCH_TO_AUTO"},
    {ActionCommand::VIN_REQ, "VIN_REQ"},
    {ActionCommand::ENTER_MISSION, "ENTER_MISSION"},
    {ActionCommand::EXIT_MISSION, "EXIT_MISSION"},
};

constexpr double kMovesOn = 2.0;  ///< a vehicle that moves so long after START was sent has taken it [s]

bool isHold(std::uint8_t action) { return action == ActionCommand::STOP || action == ActionCommand::PULL_OVER; }

/// Those of which the planner can follow one only.
bool isStopOrGo(std::uint8_t action) { return isHold(action) || action == ActionCommand::START; }

/// Those that the planner takes note of and that move nothing by themselves.
bool isAcknowledged(std::uint8_t action) { return !isStopOrGo(action) && action != ActionCommand::VIN_REQ; }

CommandStatus finished(std::int64_t command_id, const std::string& message) {
  return makeStatus(command_id, CommandStatus::FINISHED, ErrorCode::kOk, message);
}

}  // namespace

std::string nameOfAction(std::uint8_t action) {
  for (const auto& [known, name] : kActions) {
    if (known == action) return name;
  }
  return "";
}

std::string knownActions() {
  std::string names;
  for (const auto& [action, name] : kActions) {
    names += text(names.empty() ? "" : ", ", name, " (", static_cast<int>(action), ")");
  }
  return names;
}

PendingActionParams::PendingActionParams()
    : scenarios({{ActionCommand::FOLLOW, {"LANE_FOLLOW"}},
                 {ActionCommand::CHANGE_LEFT, {"CHANGE_LEFT"}},
                 {ActionCommand::CHANGE_RIGHT, {"CHANGE_RIGHT"}},
                 {ActionCommand::PULL_OVER, {"EMERGENCY_PULL_OVER"}},
                 {ActionCommand::STOP, {"EMERGENCY_STOP"}},
                 {ActionCommand::ENTER_MISSION, {"ENTER_MISSION"}},
                 {ActionCommand::EXIT_MISSION, {"EXIT_MISSION"}}}) {}

PendingActions::Changes PendingActions::add(const AdmittedCommand& command, std::uint8_t action, double now) {
  const auto end = [&](const Pending& pending) -> std::optional<CommandStatus> {
    if (!isStopOrGo(action) || !isStopOrGo(pending.action) || action == pending.action) return std::nullopt;
    return makeStatus(pending.command.id, CommandStatus::ERROR, ErrorCode::kSuperseded,
                      text("superseded by command ", command.id, ", ", nameOfAction(action)));
  };
  Changes changes = endWhere(&pending_, end);
  Pending pending;
  pending.command = command;
  pending.action = action;
  pending.deadline = now + (isHold(action) ? params_.stop_timeout : params_.timeout);
  pending.sent_at = ros::Time::now();
  pending.was_standing = is_standing_;
  const Changes dropped = addPending(&pending_, pending);
  changes.insert(changes.end(), dropped.begin(), dropped.end());
  return changes;
}

PendingActions::Changes PendingActions::onMotionSent(const AdmittedCommand& motion) {
  return endWhere(&pending_, [&](const Pending& pending) -> std::optional<CommandStatus> {
    if (!isHold(pending.action) || pending.command.arrival > motion.arrival) return std::nullopt;
    return makeStatus(pending.command.id, CommandStatus::ERROR, ErrorCode::kSuperseded,
                      text("superseded by motion command ", motion.id, ", which was sent after it"));
  });
}

bool PendingActions::isShown(const Pending& pending) const {
  const auto known = params_.scenarios.find(pending.action);
  if (known == params_.scenarios.end()) return false;
  return std::find(known->second.begin(), known->second.end(), scenario_) != known->second.end();
}

std::optional<CommandStatus> PendingActions::endOfHold(const Pending& pending) const {
  if (!pending.is_reported || !isShown(pending)) return std::nullopt;
  return finished(pending.command.id, text("the planner is in the scenario ", scenario_, " and reports finished"));
}

std::optional<CommandStatus> PendingActions::afterReport(const CommandStatus& report, bool is_meant,
                                                         Pending* pending) const {
  if (report.status == CommandStatus::ERROR && is_meant) return endFromReport(pending->command.id, report);
  if (report.status != CommandStatus::FINISHED) return std::nullopt;
  if (isHold(pending->action)) {
    pending->is_reported = pending->is_reported || is_meant || isShown(*pending);
    return endOfHold(*pending);
  }
  if (!is_meant || !isAcknowledged(pending->action)) return std::nullopt;
  return finished(pending->command.id, text("the planner reports finished: ", report.message));
}

PendingActions::Changes PendingActions::onPlannerStatus(const CommandStatus& status, const SentMotion* motion) {
  // A report without id is rather about an action that is just taken note of than about a stop that takes its time,
  // unless the planner shows that it is stopping.
  const bool some_are_acknowledged = std::any_of(pending_.begin(), pending_.end(),
                                                 [](const Pending& pending) { return isAcknowledged(pending.action); });
  return endWhere(&pending_, [&](Pending& pending) -> std::optional<CommandStatus> {
    if (pending.action == ActionCommand::VIN_REQ) return std::nullopt;
    if (isOlder(status.header.stamp, pending.sent_at, params_.clock_skew)) return std::nullopt;
    const bool has_own_id = status.command_id == pending.command.id;
    const bool is_about_motion = isHold(pending.action) && motion != nullptr &&
                                 status.command_id == motion->command.id && status.status == CommandStatus::FINISHED;
    if (!has_own_id && !is_about_motion && status.command_id != 0) return std::nullopt;
    const bool is_meant = has_own_id || is_about_motion || isAcknowledged(pending.action) || !some_are_acknowledged;
    return afterReport(status, is_meant, &pending);
  });
}

PendingActions::Changes PendingActions::onScenario(const std::string& scenario) {
  scenario_ = scenario;
  return endWhere(&pending_, [&](const Pending& pending) -> std::optional<CommandStatus> {
    if (isHold(pending.action)) return endOfHold(pending);
    if (!isShown(pending)) return std::nullopt;
    return finished(pending.command.id, "the planner is in the scenario " + scenario);
  });
}

PendingActions::Changes PendingActions::onChassis(const Chassis& chassis) {
  const bool tells_speed = std::isfinite(chassis.speed_mps);
  const bool moves = tells_speed && std::abs(chassis.speed_mps) > params_.moving_speed;
  is_standing_ = tells_speed && !moves;
  return endWhere(&pending_, [&](Pending& pending) -> std::optional<CommandStatus> {
    const bool moves_on = now_ >= pending.deadline - params_.timeout + kMovesOn;
    if (pending.action == ActionCommand::START && moves && (pending.was_standing || moves_on)) {
      return finished(pending.command.id, text("the vehicle moves at ", chassis.speed_mps, " m/s"));
    }
    pending.was_standing = pending.was_standing || is_standing_;
    if (pending.action == ActionCommand::VIN_REQ && !chassis.vin.empty()) {
      return finished(pending.command.id, "vin " + chassis.vin);
    }
    return std::nullopt;
  });
}

void PendingActions::keepWhere(const std::function<bool(CommandSerial)>& is_running) {
  external_command::keepWhere(is_running, &pending_);
}

PendingActions::Changes PendingActions::onTime(double now) {
  now_ = now;
  return endWhere(&pending_, [&](const Pending& pending) -> std::optional<CommandStatus> {
    if (now < pending.deadline) return std::nullopt;
    const bool is_hold = isHold(pending.action);
    return makeStatus(
        pending.command.id, CommandStatus::UNKNOWN, ErrorCode::kOk,
        text(nameOfAction(pending.action), " was sent, but nothing showed its end within ",
             is_hold ? params_.stop_timeout : params_.timeout, is_hold ? " s (~stop_timeout)" : " s (~timeout)"));
  });
}

}  // namespace external_command
