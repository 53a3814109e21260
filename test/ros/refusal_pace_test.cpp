// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/refusal_pace.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace external_command {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

Clock::duration timeOf(int answers, RefusalPace* pace) {
  const Clock::time_point begin = Clock::now();
  for (int i = 0; i < answers; ++i) pace->pauseIfFlooded();
  return Clock::now() - begin;
}

TEST(RefusalPace, HoldsBackAFlood) {
  RefusalPace pace(1);
  EXPECT_GE(timeOf(100, &pace), milliseconds(300));
}

TEST(RefusalPace, LetsSingleAnswersLeaveAtOnce) {
  RefusalPace pace(1);
  timeOf(100, &pace);
  std::this_thread::sleep_for(milliseconds(250));  // so that nothing is left of the flood
  const auto pauses = [&] { return timeOf(1, &pace) >= milliseconds(50); };
  int paused = 0;
  for (int i = 0; i < 10; ++i) paused += pauses() ? 1 : 0;
  EXPECT_LE(paused, 2) << "a machine that is late by itself may seem to pause";
}

TEST(RefusalPace, LeavesThreadsForOthers) {
  RefusalPace pace(0);
  const Clock::time_point begin = Clock::now();
  timeOf(1000, &pace);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5)) << "1000 pauses would take 50 s";
}

}  // namespace
}  // namespace external_command
