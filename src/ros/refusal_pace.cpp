// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/refusal_pace.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

namespace external_command {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kRefusalPause(50);
constexpr std::chrono::milliseconds kPeriod(10);  // between two answers of a flood that leave at once
constexpr int kBurst = 20;

/// Of the whole process: the processor is shared by all services.
bool isFlood() {
  static std::mutex mutex;
  static Clock::time_point next;
  const std::lock_guard<std::mutex> lock(mutex);
  const Clock::time_point now = Clock::now();
  next = std::max(next, now - kBurst * kPeriod);
  if (next > now) return true;
  next += kPeriod;
  return false;
}

}  // namespace

void RefusalPace::pauseIfFlooded() {
  if (!isFlood()) return;
  if (++pausing_ <= most_pausing_) std::this_thread::sleep_for(kRefusalPause);
  --pausing_;
}

}  // namespace external_command
