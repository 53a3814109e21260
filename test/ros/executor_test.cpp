// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <stdexcept>
#include <thread>

namespace external_command {
namespace {

TEST(Executor, RunsAsManyJobsAtOnceAsItHasThreads) {
  Executor executor(ExecutorOptions{"three", 3});
  std::promise<void> last_came;
  const std::shared_future<void> all_came = last_came.get_future().share();
  std::atomic<int> came{0}, waited{0};
  for (int i = 0; i < 3; ++i) {
    executor.post([&] {
      if (++came == 3) last_came.set_value();
      waited += all_came.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
    });
  }
  ASSERT_EQ(all_came.wait_for(std::chrono::seconds(10)), std::future_status::ready);
  executor.stop();
  EXPECT_EQ(waited, 3);
}

TEST(Executor, WaitsForARunningJobWhenItStopsAndDropsTheOthers) {
  Executor executor;
  std::promise<void> began;
  bool has_ended = false;
  int dropped_ran = 0;
  executor.post([&] {
    began.set_value();
    executor.post([&] { ++dropped_ran; });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    has_ended = true;
  });
  began.get_future().wait();
  executor.stop();
  EXPECT_TRUE(has_ended);
  executor.post([&] { ++dropped_ran; });
  executor.stop();
  EXPECT_EQ(dropped_ran, 0);
}

TEST(Executor, GoesOnAfterAJobThatThrows) {
  Executor executor;
  const std::uint64_t caught = caughtExceptions();
  executor.post([] { throw std::runtime_error("a broken job"); });
  executor.post([] { throw 7; });
  std::promise<void> ran;
  executor.post([&] { ran.set_value(); });
  ASSERT_EQ(ran.get_future().wait_for(std::chrono::seconds(10)), std::future_status::ready);
  EXPECT_EQ(caughtExceptions(), caught + 2);
}

TEST(Executor, TellsAJobWhatTheStampWasWhenItWasPosted) {
  std::uint64_t next = 0;
  ExecutorOptions options;
  options.stamp = [&] { return ++next; };
  Executor executor(options);
  std::promise<void> go;
  std::promise<std::uint64_t> second;
  executor.post([&] { go.get_future().wait(); });
  executor.post([&] { second.set_value(GuardedQueue::stampOfRunningCallback()); });
  next = 100;
  go.set_value();
  EXPECT_EQ(second.get_future().get(), 2u) << "though it ran later";
  EXPECT_EQ(GuardedQueue::stampOfRunningCallback(), 0u) << "no job runs in this thread";
}

}  // namespace
}  // namespace external_command
