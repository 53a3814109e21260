// SPDX-License-Identifier: Apache-2.0
#include "speed_command_processor.h"

#include "external_command/core/text.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/stamped.h"

namespace external_command {

SpeedCommandProcessor::SpeedCommandProcessor() : ServiceCommandProcessor<Speed>("external_command/speed") {}

SpeedCommandProcessor::~SpeedCommandProcessor() { stopServing(); }

void SpeedCommandProcessor::start() {
  ServiceCommandProcessor<Speed>::start();
  parameters().readWithin("max_request_age", 0.01, 86400.0, &max_request_age_);
  for (const std::string& topic : outputTopics("planning/speed_command")) {
    publishers_.push_back(context().advertise<SpeedCommand>(topic, false));
  }
}

void SpeedCommandProcessor::check(const SpeedCommand& command) const {
  requireFresh(command.header.stamp, max_request_age_);
  // the field that the kind leaves unused is sent, too
  requireNotNegative(command.target_speed, "target_speed");
  requireWithin(command.target_speed_factor, 0.0, 1.0, "target_speed_factor");
  switch (command.kind) {
    case SpeedCommand::TARGET_SPEED:
      context().params().limits.requireSpeed(command.target_speed);
      if (command.target_speed >= kLeastSpeed) return;
      throw InvalidRequest(text("target_speed is ", command.target_speed,
                                command.target_speed == 0.0 ? ", which means not given" : " m/s", "; it must be ",
                                kLeastSpeed, " m/s at least (to halt: target_speed_factor 0, or the action STOP)"));
    case SpeedCommand::TARGET_SPEED_FACTOR:
    case SpeedCommand::RESTORE_TARGET_SPEED:
      return;
    default:
      throw InvalidRequest(text("kind is ", static_cast<int>(command.kind),
                                "; it must be TARGET_SPEED (1), TARGET_SPEED_FACTOR (2) or RESTORE_TARGET_SPEED (3)"));
  }
}

CommandStatus SpeedCommandProcessor::execute(const SpeedCommand& command, const AdmittedCommand& admitted,
                                             Response* /*response*/) {
  const double limit = context().params().vehicle.max_speed;
  SpeedCommand sent = stamped(command);
  std::string message = "sent";
  if (command.kind == SpeedCommand::TARGET_SPEED && command.target_speed > limit) {
    sent.target_speed = limit;
    message = text("sent; target_speed ", command.target_speed, " m/s is above the vehicle's ", limit,
                   " m/s (~vehicle/max_speed) and was lowered to that");
  }
  context().gate().sendUnlessStopped(admitted, [&] {
    for (const ros::Publisher& publisher : publishers_) publisher.publish(sent);
  });
  context().motionWatch().noteSpeed(sent);
  return makeStatus(command.command_id, CommandStatus::FINISHED, ErrorCode::kOk, message);
}

}  // namespace external_command
