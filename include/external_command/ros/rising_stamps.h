// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

#include <atomic>
#include <cstdint>

namespace external_command {

/// Times of messages that are compared with each other: each is later than the one before, though the clock may stand
/// still between two ticks of simulated time. Thread-safe, without a lock that a planner could keep from a STOP.
class RisingStamps {
 public:
  /// The present time, or a nanosecond after the last stamp. Where the clock was set back, the present time.
  ros::Time next();

 private:
  std::atomic<std::uint64_t> last_{0};  ///< [ns]
};

}  // namespace external_command
