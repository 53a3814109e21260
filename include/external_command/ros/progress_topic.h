// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/publisher.h>

#include "external_command/ros/command_gate.h"
#include "external_command/ros/command_registry.h"

namespace external_command {

/// Publishes how far the motion that is under way has come, time and again, and once more how it has ended. Not
/// thread-safe.
class ProgressTopic {
 public:
  /// All must live as long as this.
  ProgressTopic(ros::Publisher publisher, const CommandGate& gate, const CommandRegistry& registry)
      : publisher_(std::move(publisher)), gate_(gate), registry_(registry) {}

  /// To be called at the rate of the topic.
  void publish();

 private:
  void publish(CommandSerial serial) const;

  const ros::Publisher publisher_;
  const CommandGate& gate_;
  const CommandRegistry& registry_;
  CommandSerial told_ = 0;  ///< that ran when it was published last; 0: none
};

}  // namespace external_command
