// SPDX-License-Identifier: Apache-2.0
#include "heard_chassis.h"

#include <ros/time.h>

#include <algorithm>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/ros/steady_time.h"

namespace external_command {

bool HeardChassis::take(const Chassis& chassis) {
  const double age = chassis.header.stamp.isZero() ? 0.0 : ros::Time::now().toSec() - chassis.header.stamp.toSec();
  odd_stamp_.clear();
  if (age < -params_.max_future_stamp) {
    odd_stamp_ = text("the report of the chassis on ", params_.topic, " is stamped ", seconds(-age),
                      " in the future; the limit is ", seconds(params_.max_future_stamp),
                      " (~max_future_stamp): do the clocks agree?");
    return false;
  }
  reported_ = ReportedMode{chassis.driving_mode, steadyNow() - std::max(0.0, age)};
  return true;
}

std::optional<ReportedMode> HeardChassis::freshMode() const {
  if (!reported_ || steadyNow() - reported_->time > params_.max_age) return std::nullopt;
  return reported_;
}

void HeardChassis::require() const {
  if (freshMode()) return;
  if (!odd_stamp_.empty()) throw NotReady(odd_stamp_);
  if (!reported_) {
    throw NotReady(
        text("the chassis is not heard of: no message came on ", params_.topic, " (~chassis_name); is it running?"));
  }
  throw NotReady(text("the chassis is not heard of any more: its last report is ",
                      seconds(steadyNow() - reported_->time), " old; the limit is ", seconds(params_.max_age), " (",
                      params_.max_age_name, ")"));
}

std::string HeardChassis::words() const {
  require();
  return text("the chassis reports ", nameOfMode(freshMode()->mode));
}

}  // namespace external_command
