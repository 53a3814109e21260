// SPDX-License-Identifier: Apache-2.0
#include "chassis_command_processor.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "external_command/Chassis.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/stamped.h"
#include "external_command/ros/steady_time.h"

namespace external_command {

namespace {

constexpr double kTimeoutTick = 0.1;  // of the time-out [s]

bool isName(std::string_view word) {
  const auto belongs = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0 &&
         std::all_of(word.begin(), word.end(), belongs);
}

bool isType(std::string_view type) {
  const std::size_t slash = type.find('/');
  return slash != std::string_view::npos && isName(type.substr(0, slash)) && isName(type.substr(slash + 1));
}

bool isMd5(std::string_view digits) {
  return digits.size() == 32 && digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// What it holds is not looked at: its type may be known to nobody but the chassis.
void checkAny(const Any& any, const std::string& field) {
  if (any.type.empty() && any.md5sum.empty() && any.data.empty()) return;
  if (!isType(any.type)) {
    throw InvalidRequest(text(field, ".type is ", quoted(any.type), "; it must be package/Type"));
  }
  if (!isMd5(any.md5sum)) {
    throw InvalidRequest(text(field, ".md5sum is ", quoted(any.md5sum), "; it must be the 32 hexadecimal digits of ",
                              printable(any.type)));
  }
}

}  // namespace

ChassisCommandProcessor::ChassisCommandProcessor()
    : ServiceCommandProcessor<ChassisControl>("external_command/chassis") {}

ChassisCommandProcessor::~ChassisCommandProcessor() {
  stopServing();
  watch_executor_.stop();
  if (pending_) record(pending_->giveUp());
}

void ChassisCommandProcessor::start() {
  ServiceCommandProcessor<ChassisControl>::start();
  double timeout = 5.0;
  parameters().readWithin("timeout", 0.01, 86400.0, &timeout);
  parameters().readWithin("max_request_age", 0.01, 86400.0, &max_request_age_);
  pending_.emplace(timeout);
  for (const std::string& topic : outputTopics("canbus/chassis_control")) {
    publishers_.push_back(context().advertise<ChassisCommand>(topic, false));
  }
  subscribe(timeout);
}

void ChassisCommandProcessor::subscribe(double timeout) {
  std::string topic = "canbus/chassis";
  parameters().readName("chassis_name", &topic);
  chassis_.emplace(
      HeardChassisParams{getNodeHandle().resolveName(topic), timeout, "~timeout", context().params().max_future_stamp});
  needs("chassis", [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return chassis_->words();
  });
  ros::NodeHandle nh(getNodeHandle());
  nh.setCallbackQueue(watch_executor_.queue());
  const auto on_chassis = [this](const ros::MessageEvent<Chassis const>& event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!chassis_->take(*event.getConstMessage())) return;
    record(pending_->onChassis(event.getConstMessage()->signal));
  };
  chassis_subscriber_ = subscribeBounded<Chassis>(nh, topic, 10, on_chassis, context().params().requests);
  timer_ = watch_executor_.every(
      kTimeoutTick, [this] { onTick(); }, [this] { return is_waiting_.load(); });
}

void ChassisCommandProcessor::onTick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  pending_->keepWhere([this](CommandSerial serial) { return context().registry().isRunning(serial); });
  record(pending_->onTime(steadyNow()));
  is_waiting_ = !pending_->empty();
}

void ChassisCommandProcessor::check(const ChassisCommand& command) const {
  requireFresh(command.header.stamp, max_request_age_);
  checkSignals(command.basic_signal);
  checkAny(command.custom_operation, "custom_operation");
}

CommandStatus ChassisCommandProcessor::execute(const ChassisCommand& command, const AdmittedCommand& admitted,
                                               Response* /*response*/) {
  const std::lock_guard<std::mutex> lock(mutex_);
  context().registry().requireRunning(admitted);
  const bool changes_signals = commandsAny(command.basic_signal);
  const ChassisCommand sent = stamped(command);
  context().gate().sendUnlessStopped(admitted, [&] {
    if (changes_signals) record(pending_->add(admitted, command.basic_signal, steadyNow()));
    is_waiting_ = true;
    for (const ros::Publisher& publisher : publishers_) publisher.publish(sent);
  });
  if (!changes_signals) {
    return makeStatus(command.command_id, CommandStatus::FINISHED, ErrorCode::kOk,
                      "sent; it changes no signal that could be waited for");
  }
  return makeStatus(command.command_id, CommandStatus::RUNNING, ErrorCode::kOk, "sent");
}

void ChassisCommandProcessor::record(const PendingSignals::Changes& changes) {
  for (const StatusChange& change : changes) context().registry().update(change);
}

}  // namespace external_command
