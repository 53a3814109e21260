// SPDX-License-Identifier: Apache-2.0
#include "action_command_processor.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "external_command/ControlPad.h"
#include "external_command/PlanningPad.h"
#include "external_command/core/text.h"

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

double now() { return ros::SteadyTime::now().toSec(); }

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
  watch_lane_.stop();
}

void ActionCommandProcessor::start() {
  ServiceCommandProcessor<Action>::start();
  readParameters();
  for (const std::string& topic : outputTopics("planning/pad")) {
    planning_pads_.push_back(context().advertise<PlanningPad>(topic, false));
  }
  std::string control_pad = "control/pad";
  parameters().readName("control_pad_name", &control_pad);
  control_pad_ = context().advertise<ControlPad>(control_pad, false);
  subscribe();
}

void ActionCommandProcessor::readParameters() {
  parameters().readWithin("mode_switch_tries", 1, 100, &mode_switch_params_.tries);
  parameters().readWithin("mode_switch_interval", 0.01, 60.0, &mode_switch_params_.interval);
  parameters().readWithin("max_chassis_age", 0.01, 3600.0, &max_chassis_age_);
  PendingActionParams params;
  parameters().readWithin("timeout", 0.01, 86400.0, &params.timeout);
  parameters().readWithin("stop_timeout", 0.01, 86400.0, &params.stop_timeout);
  parameters().readWithin("moving_speed", 0.0, 100.0, &params.moving_speed);
  const ParameterReader scenarios = parameters().within("scenarios");
  for (auto& [action, names] : params.scenarios) scenarios.read(parameterNameOf(action), &names);
  pending_.emplace(params);
}

void ActionCommandProcessor::subscribe() {
  std::string chassis_topic = "canbus/chassis", state_topic = "planning/state";
  parameters().readName("chassis_name", &chassis_topic);
  parameters().readName("planning_state_name", &state_topic);

  ros::NodeHandle nh(getNodeHandle());
  nh.setCallbackQueue(watch_lane_.queue());
  const boost::function<void(const Chassis&)> on_chassis = [this](const Chassis& chassis) { onChassis(chassis); };
  const boost::function<void(const PlanningState&)> on_state = [this](const PlanningState& state) {
    const std::lock_guard<std::mutex> lock(mutex_);
    record(pending_->onScenario(state.scenario));
  };
  const boost::function<void(const CommandStatus&)> on_status = [this](const CommandStatus& status) {
    const std::lock_guard<std::mutex> lock(mutex_);
    record(pending_->onPlannerStatus(status, context().gate().lastSent()));
  };
  subscribers_.push_back(nh.subscribe<Chassis>(chassis_topic, 10, on_chassis));
  subscribers_.push_back(nh.subscribe<PlanningState>(state_topic, 10, on_state));
  for (const std::string& topic : topicNames("input_command_status_name", "planning/command_status")) {
    subscribers_.push_back(nh.subscribe<CommandStatus>(topic, 100, on_status));
  }
  timer_ = nh.createSteadyTimer(ros::WallDuration(kTick), [this](const ros::SteadyTimerEvent&) { onTick(); });
}

void ActionCommandProcessor::check(const ActionCommand& command) const {
  if (!nameOfAction(command.command).empty()) return;
  throw InvalidRequest(text("command is ", static_cast<int>(command.command), "; the actions are ", knownActions()));
}

CommandStatus ActionCommandProcessor::execute(const ActionCommand& command, const CommandGate::Arrival& /*arrival*/,
                                              Response* /*response*/) {
  switch (command.command) {
    case ActionCommand::CLEAR_PLANNING:
      return clearPlanning(command.command_id);
    case ActionCommand::SWITCH_TO_MANUAL:
      return switchMode(command.command_id, ModeSwitch::Target::kManual);
    case ActionCommand::SWITCH_TO_AUTO:
      return switchMode(command.command_id, ModeSwitch::Target::kAuto);
    default:
      return sendAndWatch(command);
  }
}

CommandStatus ActionCommandProcessor::sendAndWatch(const ActionCommand& command) {
  const std::lock_guard<std::mutex> lock(mutex_);
  record(pending_->add(command.command_id, command.command, now()));
  if (command.command == ActionCommand::STOP) {
    context().gate().stop([this] { sendToPlanning(PlanningPad::STOP); });
  } else if (command.command == ActionCommand::VIN_REQ) {
    sendToControl(ControlPad::VIN_REQ);
  } else {
    sendToPlanning(kPlanningPads.at(command.command));
  }
  CommandStatus status =
      makeStatus(command.command_id, CommandStatus::RUNNING, ErrorCode::kOk, nameOfAction(command.command) + " sent");
  context().registry().update(status);
  return status;
}

CommandStatus ActionCommandProcessor::clearPlanning(std::int64_t command_id) {
  const auto running = context().gate().stop([this] { sendToPlanning(PlanningPad::CLEAR_PLANNING); });
  if (running) {
    context().registry().update(makeStatus(*running, CommandStatus::ERROR, ErrorCode::kCancelled,
                                           text("cancelled by CLEAR_PLANNING, command ", command_id)));
  }
  return makeStatus(command_id, CommandStatus::FINISHED, ErrorCode::kOk, "CLEAR_PLANNING sent");
}

CommandStatus ActionCommandProcessor::switchMode(std::int64_t command_id, ModeSwitch::Target target) {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireChassis();
  if (switch_) {
    context().registry().update(makeStatus(switch_->command_id, CommandStatus::ERROR, ErrorCode::kSuperseded,
                                           text("superseded by mode switch ", command_id)));
  }
  switch_.emplace(RunningSwitch{command_id, ModeSwitch(target, mode_switch_params_, mode_is_settled_)});
  CommandStatus status;
  if (target == ModeSwitch::Target::kManual) {
    context().gate().stop([&] { status = advanceSwitch(); });
  } else {
    status = advanceSwitch();
  }
  context().registry().update(status);
  return status;
}

CommandStatus ActionCommandProcessor::advanceSwitch() {
  const std::int64_t id = switch_->command_id;
  ModeSwitch& decision = switch_->decision;
  switch (decision.next(chassis_.driving_mode, now())) {
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
      return makeStatus(id, CommandStatus::FINISHED, ErrorCode::kOk,
                        text("the chassis reports ", nameOfMode(chassis_.driving_mode)));
    case ModeSwitch::Step::kFailed: {
      const std::string reason = decision.describe(chassis_.driving_mode);
      switch_.reset();
      return makeStatus(id, CommandStatus::ERROR, ErrorCode::kRefusedByVehicle, reason);
    }
    case ModeSwitch::Step::kWait:
      break;
  }
  return makeStatus(id, CommandStatus::RUNNING, ErrorCode::kOk, decision.describe(chassis_.driving_mode));
}

void ActionCommandProcessor::requireChassis() const {
  if (chassis_time_.isZero()) {
    throw NotReady("nothing was heard from the chassis; is it running (~chassis_name)?");
  }
  const double age = (ros::SteadyTime::now() - chassis_time_).toSec();
  if (age > max_chassis_age_) {
    throw NotReady(text("the last message of the chassis is ", age, " s old; the limit is ", max_chassis_age_,
                        " s (~max_chassis_age): is it still running?"));
  }
}

void ActionCommandProcessor::onChassis(const Chassis& chassis) {
  const std::lock_guard<std::mutex> lock(mutex_);
  chassis_ = chassis;
  chassis_time_ = ros::SteadyTime::now();
  record(pending_->onChassis(chassis));
  if (switch_) context().registry().update(advanceSwitch());
}

void ActionCommandProcessor::onTick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  record(pending_->onTime(now()));
  if (switch_) context().registry().update(advanceSwitch());
}

void ActionCommandProcessor::record(const PendingActions::Changes& changes) {
  for (const CommandStatus& status : changes) context().registry().update(status);
}

void ActionCommandProcessor::sendToPlanning(std::uint8_t pad) const {
  PlanningPad message;
  message.header.stamp = ros::Time::now();
  message.action = pad;
  for (const ros::Publisher& publisher : planning_pads_) publisher.publish(message);
}

void ActionCommandProcessor::sendToControl(std::uint8_t pad) const {
  ControlPad message;
  message.header.stamp = ros::Time::now();
  message.action = pad;
  control_pad_.publish(message);
}

}  // namespace external_command
