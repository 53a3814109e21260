// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/in_parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace external_command {
namespace {

TEST(InParallel, DoesEachPartOnceAndTheFirstOnTheCallersThread) {
  std::vector<int> calls(7, 0);
  std::thread::id first;
  inParallel(calls.size(), [&](std::size_t part) {
    ++calls[part];
    if (part == 0) first = std::this_thread::get_id();
  });
  EXPECT_EQ(calls, std::vector<int>(7, 1));
  EXPECT_EQ(first, std::this_thread::get_id());
}

TEST(InParallel, DoesAllPartsAtOnce) {
  std::mutex mutex;
  std::condition_variable changed;
  int begun = 0;
  inParallel(4, [&](std::size_t) {
    std::unique_lock<std::mutex> lock(mutex);
    ++begun;
    changed.notify_all();
    EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(60), [&] { return begun == 4; }));
  });
}

TEST(InParallel, DoesNothingWhereThereIsNoPart) {
  inParallel(0, [](std::size_t) { FAIL() << "called"; });
}

TEST(InParallel, ThrowsWhatTheLowestOfThePartsThrewWhenAllAreDone) {
  std::atomic<int> done{0};
  try {
    inParallel(5, [&](std::size_t part) {
      ++done;
      if (part >= 2) throw std::runtime_error(std::to_string(part));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "2");
  }
  EXPECT_EQ(done, 5);
}

TEST(ParallelParts, AreAtLeastOneAndNotMoreThanAskedFor) {
  EXPECT_EQ(parallelParts(0), 1U);
  EXPECT_EQ(parallelParts(1), 1U);
  EXPECT_LE(parallelParts(2), 2U);
  EXPECT_GE(parallelParts(1000), 1U);
}

}  // namespace
}  // namespace external_command
