// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

#include <mutex>

namespace external_command {

/// Times of messages that are compared with each other: each is later than the one before, though the clock may stand
/// still between two ticks of simulated time. Thread-safe.
class RisingStamps {
 public:
  /// The present time, or a nanosecond after the last stamp. Where the clock was set back, the present time.
  ros::Time next();

 private:
  std::mutex mutex_;
  ros::Time last_;
};

}  // namespace external_command
