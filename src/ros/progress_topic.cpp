// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/progress_topic.h"

#include "external_command/ros/status.h"

namespace external_command {

void ProgressTopic::publish() {
  const auto motion = gate_.motion();
  const CommandSerial serial = motion && registry_.isRunning(motion->command.serial) ? motion->command.serial : 0;
  if (told_ != 0 && told_ != serial) publish(told_);
  told_ = serial;
  if (serial != 0) publish(serial);
}

void ProgressTopic::publish(CommandSerial serial) const {
  std::optional<CommandStatus> status = registry_.statusOf(serial);
  if (!status) return;
  status->header.stamp = ros::Time::now();
  publisher_.publish(*status);
}

}  // namespace external_command
