// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/dedicated_lane.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

namespace external_command {
namespace {

TEST(DedicatedLane, RunsAsManyJobsAtOnceAsItHasThreads) {
  DedicatedLane lane(3);
  std::promise<void> last_came;
  const std::shared_future<void> all_came = last_came.get_future().share();
  std::atomic<int> came{0}, waited{0};
  for (int i = 0; i < 3; ++i) {
    lane.post([&] {
      if (++came == 3) last_came.set_value();
      waited += all_came.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
    });
  }
  ASSERT_EQ(all_came.wait_for(std::chrono::seconds(10)), std::future_status::ready);
  lane.stop();
  EXPECT_EQ(waited, 3);
}

TEST(DedicatedLane, WaitsForARunningJobWhenItStopsAndDropsTheOthers) {
  DedicatedLane lane;
  std::promise<void> began;
  bool has_ended = false;
  int dropped_ran = 0;
  lane.post([&] {
    began.set_value();
    lane.post([&] { ++dropped_ran; });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    has_ended = true;
  });
  began.get_future().wait();
  lane.stop();
  EXPECT_TRUE(has_ended);
  lane.post([&] { ++dropped_ran; });
  lane.stop();
  EXPECT_EQ(dropped_ran, 0);
}

}  // namespace
}  // namespace external_command
