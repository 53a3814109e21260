// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/goal_arrival.h"

#include <algorithm>
#include <thread>

namespace external_command {

namespace {

constexpr std::chrono::milliseconds kGoalPeriod(10);
constexpr int kGoalsAtOnce = 20;

}  // namespace

void ArrivalPace::pauseIfFlooded() {
  const auto now = std::chrono::steady_clock::now();
  next_ = std::max(next_, now - kGoalsAtOnce * kGoalPeriod) + kGoalPeriod;
  if (next_ > now) std::this_thread::sleep_until(next_);
}

}  // namespace external_command
