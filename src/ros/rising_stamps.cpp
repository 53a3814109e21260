// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/rising_stamps.h"

#include <algorithm>

namespace external_command {

namespace {

constexpr std::uint64_t kSetBack = 100'000'000;  ///< a clock that is put right by less goes on from the last stamp [ns]

}  // namespace

ros::Time RisingStamps::next() {
  const std::uint64_t now = ros::Time::now().toNSec();
  std::uint64_t last = last_, stamp = 0;
  do {
    const bool goes_on = last > 0 && now + kSetBack >= last;
    stamp = goes_on ? std::max(now, last + 1) : now;
  } while (!last_.compare_exchange_weak(last, stamp));
  ros::Time time;
  return time.fromNSec(stamp);
}

}  // namespace external_command
