// SPDX-License-Identifier: Apache-2.0
#include "stop_line.h"

#include <ros/node_handle.h>
#include <ros/service.h>

namespace external_command {

bool StopLine::keep() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_busy_ || kept_.isValid()) return true;
  }
  if (!ros::service::exists(service_, false)) return false;
  ros::ServiceClient made = ros::NodeHandle().serviceClient<Action>(service_, true);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!is_busy_) kept_ = made;
  return made.isValid();
}

bool StopLine::call(Action* action) {
  ros::ServiceClient kept;
  bool is_free = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_free = !is_busy_ && kept_.isValid();
    if (is_free) {
      kept = kept_;
      is_busy_ = true;
    }
  }
  if (is_free) {
    const bool is_answered = kept.call(*action);
    const std::lock_guard<std::mutex> lock(mutex_);
    is_busy_ = false;
    if (is_answered) return true;
    kept_ = ros::ServiceClient();
  }
  return ros::service::call(service_, *action);
}

}  // namespace external_command
