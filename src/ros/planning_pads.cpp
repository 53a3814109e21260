// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_pads.h"

#include <utility>

#include "external_command/PlanningPad.h"

namespace external_command {

void PlanningPads::use(std::vector<ros::Publisher> publishers) {
  const std::lock_guard<std::mutex> lock(mutex_);
  publishers_ = std::move(publishers);
}

void PlanningPads::send(std::uint8_t action, const ros::Time& stamp) const {
  PlanningPad message;
  message.header.stamp = stamp;
  message.action = action;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const ros::Publisher& publisher : publishers_) publisher.publish(message);
}

}  // namespace external_command
