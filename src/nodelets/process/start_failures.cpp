// SPDX-License-Identifier: Apache-2.0
#include "start_failures.h"

#include <ros/param.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kLongestPause = 60.0;  // [s]
constexpr double kRespawnTakes = 15.0;  // from an end to the next start, at most [s]

}  // namespace

double pauseAfter(int failures) {
  return failures <= 1 ? 0.0 : std::min(kLongestPause, std::pow(2.0, std::min(failures, 10) - 1));
}

StartFailures::StartFailures(const std::string& node) : key_(node + "/start_failures") {
  double ended_at = 0.0;
  if (!ros::param::get(key_ + "/ended_at", ended_at)) return;
  if (std::abs(ros::WallTime::now().toSec() - ended_at) < kRespawnTakes) {
    ros::param::get(key_ + "/reason", reason_);
    ros::param::get(key_ + "/count", count_);
  }
  ros::param::del(key_);
}

double StartFailures::note(const std::string& reason) {
  count_ = reason == reason_ ? count_ + 1 : 1;
  reason_ = reason;
  const double pause = pauseAfter(count_);
  ros::param::set(key_ + "/reason", reason_);
  ros::param::set(key_ + "/count", count_);
  ros::param::set(key_ + "/ended_at", ros::WallTime::now().toSec() + pause);
  return pause;
}

}  // namespace external_command
