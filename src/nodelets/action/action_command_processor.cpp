// SPDX-License-Identifier: Apache-2.0
#include "action_command_processor.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "external_command/ControlPad.h"
#include "external_command/PlanningPad.h"
#include "external_command/core/text.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/steady_time.h"

namespace external_command {

namespace {

constexpr double kTick = 0.02;  // of time-outs and repeated tries [s]

const std::map<std::uint8_t, std::uint8_t> kPlanningPads = {
    {ActionCommand::FOLLOW, PlanningPad::FOLLOW},
    {ActionCommand::CHANGE_LEFT, PlanningPad::CHANGE_LEFT},
    {ActionCommand::CHANGE_RIGHT, PlanningPad::CHANGE_RIGHT},
    {ActionCommand::PULL_OVER, PlanningPad::PULL_OVER},
    {ActionCommand::STOP, PlanningPad::STOP},
    {ActionCommand::START, PlanningPad::RESUME_CRUISE},
    {ActionCommand::ENTER_MISSION, PlanningPad::ENTER_MISSION},
    {ActionCommand::EXIT_MISSION, PlanningPad::EXIT_MISSION},
};

/// "PULL_OVER" -> "pull_over".
std::string parameterNameOf(std::uint8_t action) {
  std::string name = nameOfAction(action);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

}  // namespace

ActionCommandProcessor::ActionCommandProcessor() : ServiceCommandProcessor<Action>("external_command/action") {}

ActionCommandProcessor::~ActionCommandProcessor() {
  stopServing();
  if (contextPtr() == nullptr) return;
  {
    const std::lock_guard<std::mutex> nothing_is_sent(context().sendingMutex());
    sent_motions_.disconnect();
  }
  watch_executor_.stop();
  if (!pending_) return;
  record(pending_->giveUp());
  if (switch_) context().registry().update({switch_->command.serial, unloaded(switch_->command.id)});
}

void ActionCommandProcessor::start() {
  ServiceCommandProcessor<Action>::start();
  readParameters();
  std::vector<ros::Publisher> planning_pads;
  for (const std::string& topic : outputTopics("planning/pad")) {
    planning_pads.push_back(context().advertise<PlanningPad>(topic, false));
  }
  context().planningPads().use(planning_pads);
  std::string control_pad = "control/pad";
  parameters().readName("control_pad_name", &control_pad);
  control_pad_ = context().advertise<ControlPad>(control_pad, false);
  subscribe();
}

void ActionCommandProcessor::readParameters() {
  parameters().readWithin("mode_switch_tries", 1, 100, &mode_switch_params_.tries);
  parameters().readWithin("mode_switch_interval", 0.01, 60.0, &mode_switch_params_.interval);
  PendingActionParams params;
  parameters().readWithin("timeout", 0.01, 86400.0, &params.timeout);
  parameters().readWithin("stop_timeout", 0.01, 86400.0, &params.stop_timeout);
  parameters().readWithin("moving_speed", 0.0, 100.0, &params.moving_speed);
  const ParameterReader scenarios = parameters().within("scenarios");
  for (auto& [action, names] : params.scenarios) scenarios.read(parameterNameOf(action), &names);
  params.clock_skew = context().params().reports.clock_skew;
  pending_.emplace(params);
}

void ActionCommandProcessor::subscribe() {
  std::string chassis_topic = "canbus/chassis", state_topic = "planning/state";
  parameters().readName("chassis_name", &chassis_topic);
  parameters().readName("planning_state_name", &state_topic);
  HeardChassisParams chassis_params{getNodeHandle().resolveName(chassis_topic), 1.0, "~max_chassis_age",
                                    context().params().max_future_stamp};
  parameters().readWithin("max_chassis_age", 0.01, 3600.0, &chassis_params.max_age);
  chassis_.emplace(chassis_params);
  needs("chassis", [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return chassis_->words();
  });

  ros::NodeHandle nh(getNodeHandle());
  nh.setCallbackQueue(watch_executor_.queue());
  const auto on_chassis = [this](const ros::MessageEvent<Chassis const>& event) {
    onChassis(*event.getConstMessage());
  };
  const auto on_state = [this](const ros::MessageEvent<PlanningState const>& event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    record(pending_->onScenario(event.getConstMessage()->scenario));
  };
  const auto on_status = [this](const ros::MessageEvent<CommandStatus const>& event) {
    const auto motion = context().gate().motion();
    const std::lock_guard<std::mutex> lock(mutex_);
    record(pending_->onPlannerStatus(*event.getConstMessage(), motion.get()));
  };
  const RequestLimits& limits = context().params().requests;
  subscribers_.push_back(subscribeBounded<Chassis>(nh, chassis_topic, 10, on_chassis, limits));
  subscribers_.push_back(subscribeBounded<PlanningState>(nh, state_topic, 10, on_state, limits));
  for (const std::string& topic : topicNames("input_command_status_name", "planning/command_status")) {
    subscribers_.push_back(subscribeBounded<CommandStatus>(nh, topic, 100, on_status, limits, LongTexts::kTaken));
  }
  sent_motions_ = context().sentMotions().connect([this](const SentMotion& motion) {
    const std::lock_guard<std::mutex> lock(mutex_);
    record(pending_->onMotionSent(motion.command));
  });
  timer_ = watch_executor_.every(
      kTick, [this] { onTick(); }, [this] { return is_waiting_.load(); });
}

void ActionCommandProcessor::check(const ActionCommand& command) const {
  if (!nameOfAction(command.command).empty()) return;
  throw InvalidRequest(text("command is ", static_cast<int>(command.command), "; the actions are ", knownActions()));
}

bool ActionCommandProcessor::actsAlways(const ActionCommand& command) const {
  return command.command == ActionCommand::STOP || command.command == ActionCommand::CLEAR_PLANNING ||
         command.command == ActionCommand::SWITCH_TO_MANUAL;
}

CommandStatus ActionCommandProcessor::execute(const ActionCommand& command, const AdmittedCommand& admitted,
                                              Response* /*response*/) {
  switch (command.command) {
    case ActionCommand::CLEAR_PLANNING:
      return clearPlanning(admitted);
    case ActionCommand::SWITCH_TO_MANUAL:
      return switchMode(admitted, ModeSwitch::Target::kManual);
    case ActionCommand::SWITCH_TO_AUTO:
      return switchMode(admitted, ModeSwitch::Target::kAuto);
    default:
      return sendAndWatch(command, admitted);
  }
}

CommandStatus ActionCommandProcessor::sendAndWatch(const ActionCommand& command, const AdmittedCommand& admitted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto watch = [&] {
    record(pending_->add(admitted, command.command, steadyNow()));
    is_waiting_ = true;
  };
  if (command.command == ActionCommand::STOP) {
    watch();
    endSwitchToAuto(admitted, "STOP");
    context().gate().stop(true, [this] { context().planningPads().send(PlanningPad::STOP, context().gate().stamp()); });
  } else {
    context().registry().requireRunning(admitted);
    context().gate().sendUnlessStopped(admitted, [&] {
      watch();
      if (command.command == ActionCommand::VIN_REQ) {
        sendToControl(ControlPad::VIN_REQ);
      } else {
        context().planningPads().send(kPlanningPads.at(command.command), context().gate().stamp());
      }
    });
  }
  if (command.command == ActionCommand::START) context().showMotionAgain();
  return makeStatus(admitted.id, CommandStatus::RUNNING, ErrorCode::kOk, nameOfAction(command.command) + " sent");
}

/// What arrived before a stop is not gone on with.
void ActionCommandProcessor::endSwitchToAuto(const AdmittedCommand& stop, const char* name) {
  if (!switch_ || switch_->decision.target() != ModeSwitch::Target::kAuto) return;
  context().registry().update(
      {switch_->command.serial, makeStatus(switch_->command.id, CommandStatus::ERROR, ErrorCode::kCancelled,
                                           text("cancelled by ", name, ", command ", stop.id))});
  switch_.reset();
}

CommandStatus ActionCommandProcessor::clearPlanning(const AdmittedCommand& admitted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  endSwitchToAuto(admitted, "CLEAR_PLANNING");
  const auto cleared = context().gate().stop(
      true, [this] { context().planningPads().send(PlanningPad::CLEAR_PLANNING, context().gate().stamp()); });
  if (cleared) {
    context().registry().update(
        {cleared->command.serial, makeStatus(cleared->command.id, CommandStatus::ERROR, ErrorCode::kCancelled,
                                             text("cancelled by CLEAR_PLANNING, command ", admitted.id))});
  }
  return makeStatus(admitted.id, CommandStatus::FINISHED, ErrorCode::kOk, "CLEAR_PLANNING sent");
}

CommandStatus ActionCommandProcessor::switchMode(const AdmittedCommand& admitted, ModeSwitch::Target target) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool to_manual = target == ModeSwitch::Target::kManual;
  if (!to_manual) {
    context().registry().requireRunning(admitted);
    chassis_->require();
  }
  CommandStatus status;
  const auto begin = [&] {
    if (switch_) {
      context().registry().update(
          {switch_->command.serial, makeStatus(switch_->command.id, CommandStatus::ERROR, ErrorCode::kSuperseded,
                                               text("superseded by mode switch ", admitted.id))});
    }
    switch_.emplace(RunningSwitch{admitted, ModeSwitch(target, mode_switch_params_, mode_is_settled_, steadyNow())});
    is_waiting_ = true;
    status = advanceSwitch().status;
  };
  if (to_manual) {
    context().gate().stop(false, begin);
  } else {
    context().gate().sendUnlessStopped(admitted, begin);
  }
  return status;
}

StatusChange ActionCommandProcessor::advanceSwitch() {
  const AdmittedCommand command = switch_->command;
  ModeSwitch& decision = switch_->decision;
  const std::optional<ReportedMode> mode = chassis_->freshMode();
  const auto change = [&](std::uint8_t status, ErrorCode code, const std::string& message) {
    return StatusChange{command.serial, makeStatus(command.id, status, code, message)};
  };
  switch (decision.next(mode, steadyNow())) {
    case ModeSwitch::Step::kSendManual:
      sendToControl(ControlPad::RESET);
      mode_is_settled_ = false;
      break;
    case ModeSwitch::Step::kSendAuto:
      sendToControl(ControlPad::START);
      mode_is_settled_ = false;
      break;
    case ModeSwitch::Step::kDone:
      switch_.reset();
      mode_is_settled_ = true;
      return change(CommandStatus::FINISHED, ErrorCode::kOk, "the chassis reports " + nameOfMode(mode->mode));
    case ModeSwitch::Step::kFailed: {
      const std::string reason = decision.describe(mode);
      switch_.reset();
      return change(CommandStatus::ERROR, ErrorCode::kRefusedByVehicle, reason);
    }
    case ModeSwitch::Step::kWait:
      break;
  }
  return change(CommandStatus::RUNNING, ErrorCode::kOk, decision.describe(mode));
}

void ActionCommandProcessor::onChassis(const Chassis& chassis) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!chassis_->take(chassis)) return;
  record(pending_->onChassis(chassis));
  goOnSwitching();
}

void ActionCommandProcessor::onTick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  pending_->keepWhere([this](CommandSerial serial) { return context().registry().isRunning(serial); });
  record(pending_->onTime(steadyNow()));
  goOnSwitching();
  is_waiting_ = !pending_->empty() || switch_.has_value();
}

void ActionCommandProcessor::goOnSwitching() {
  if (switch_ && !context().registry().isRunning(switch_->command.serial)) switch_.reset();  // it was cancelled
  if (switch_) context().registry().update(advanceSwitch());
}

void ActionCommandProcessor::record(const PendingActions::Changes& changes) {
  for (const StatusChange& change : changes) context().registry().update(change);
}

void ActionCommandProcessor::sendToControl(std::uint8_t pad) const {
  ControlPad message;
  message.header.stamp = ros::Time::now();
  message.action = pad;
  control_pad_.publish(message);
}

}  // namespace external_command
