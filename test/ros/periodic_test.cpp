// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/periodic.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "external_command/ros/executor.h"

namespace external_command {
namespace {

using std::chrono::milliseconds;

template <class Condition>
bool becomes(const Condition& condition) {
  for (int i = 0; i < 500 && !condition(); ++i) std::this_thread::sleep_for(milliseconds(10));
  return condition();
}

TEST(Periodic, CallsAgainAndAgain) {
  Executor executor;
  std::atomic<int> calls{0};
  const Periodic periodic = executor.every(0.01, [&] { ++calls; });
  EXPECT_TRUE(becomes([&] { return calls >= 5; }));
}

TEST(Periodic, CallsOnlyWhileItIsWanted) {
  Executor executor;
  std::atomic<int> calls{0};
  std::atomic<bool> is_wanted{false};
  const Periodic periodic = executor.every(
      0.005, [&] { ++calls; }, [&] { return is_wanted.load(); });
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(calls, 0);
  is_wanted = true;
  EXPECT_TRUE(becomes([&] { return calls >= 3; }));
  is_wanted = false;
  std::this_thread::sleep_for(milliseconds(50));
  const int before = calls;
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(calls, before);
}

TEST(Periodic, CallsNoMoreOnceStopped) {
  Executor executor;
  std::atomic<int> calls{0};
  Periodic periodic = executor.every(0.001, [&] { ++calls; });
  ASSERT_TRUE(becomes([&] { return calls > 0; }));
  periodic.stop();
  const int before = calls;
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(calls, before);
  periodic.stop();  // does nothing
}

TEST(Periodic, WaitsForTheCallThatRunsWhenItIsStopped) {
  Executor executor;
  std::atomic<bool> has_begun{false}, has_ended{false};
  Periodic periodic = executor.every(0.001, [&] {
    has_begun = true;
    std::this_thread::sleep_for(milliseconds(100));
    has_ended = true;
  });
  ASSERT_TRUE(becomes([&] { return has_begun.load(); }));
  periodic.stop();
  EXPECT_TRUE(has_ended);
}

TEST(Periodic, MayBeStoppedByItsOwnCall) {
  Executor executor;
  std::atomic<int> calls{0};
  Periodic periodic;
  executor.post([&] {
    periodic = executor.every(0.001, [&] {
      ++calls;
      periodic.stop();
    });
  });
  ASSERT_TRUE(becomes([&] { return calls > 0; }));
  std::this_thread::sleep_for(milliseconds(30));
  EXPECT_EQ(calls, 1);
}

TEST(Periodic, SkipsCallsThatASlowOneIsInTheWayOf) {
  Executor executor;
  std::atomic<int> calls{0};
  const Periodic periodic = executor.every(0.001, [&] {
    if (++calls == 1) std::this_thread::sleep_for(milliseconds(1000));
  });
  ASSERT_TRUE(becomes([&] { return calls >= 2; }));
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_LT(calls, 500) << "a thousand have come due meanwhile";
}

TEST(Periodic, ServesThousandsSideBySide) {
  Executor executor;
  std::atomic<int> calls{0};
  std::vector<Periodic> many;
  for (int i = 0; i < 2000; ++i) many.push_back(executor.every(0.05, [&] { ++calls; }));
  EXPECT_TRUE(becomes([&] { return calls >= 4000; }));
}

}  // namespace
}  // namespace external_command
