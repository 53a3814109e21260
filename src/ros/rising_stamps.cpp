// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/rising_stamps.h"

#include <algorithm>

namespace external_command {

namespace {

const ros::Duration kSetBack(0.1);  ///< a clock that is put right by less goes on from the last stamp

}  // namespace

ros::Time RisingStamps::next() {
  const ros::Time now = ros::Time::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool is_set_back = now + kSetBack < last_;
  last_ = last_.isZero() || is_set_back ? now : std::max(now, last_ + ros::Duration(0, 1));
  return last_;
}

}  // namespace external_command
