// SPDX-License-Identifier: Apache-2.0
#include "ros/thread_crew.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <set>
#include <thread>

#include "support/comes_true.h"

namespace external_command {
namespace {

using std::chrono::milliseconds;

std::atomic<int> living{0};  // threads of crews
struct Life {
  Life() { ++living; }
  ~Life() { --living; }
};
void live() { thread_local const Life life; }

TEST(ThreadCrew, DoesAPieceOfWorkForEachCall) {
  std::atomic<int> done{0};
  ThreadCrew crew({3, live, [&] { ++done; }});
  for (int i = 0; i < 1000; ++i) crew.call();
  EXPECT_TRUE(comesTrue([&] { return done == 1000; })) << done;
  crew.stop();
  EXPECT_EQ(done, 1000);
  EXPECT_EQ(living, 0);
}

TEST(ThreadCrew, MakesThreadsForABurstAndNoMoreThanItMay) {
  std::atomic<int> in_work{0};
  std::promise<void> end;
  const std::shared_future<void> has_end = end.get_future().share();
  ThreadCrew crew({5, live, [&] {
                     ++in_work;
                     has_end.wait();
                   }});
  EXPECT_TRUE(comesTrue([] { return living == 1; }));
  for (int i = 0; i < 9; ++i) crew.call();
  EXPECT_TRUE(comesTrue([&] { return in_work == 5; })) << in_work;
  EXPECT_EQ(living, 5);
  end.set_value();
  EXPECT_TRUE(comesTrue([&] { return in_work == 9; })) << in_work << ": what waited is done too";
}

TEST(ThreadCrew, EndsTheThreadsOfABurstAndMakesThemAgainForTheNext) {
  std::atomic<int> in_work{0}, wanted{0};
  const auto work = [&] {
    ++in_work;
    comesTrue([&] { return in_work >= wanted; });
  };
  ThreadCrew crew({8, live, work, milliseconds(20)});
  for (wanted = 8; wanted <= 24; wanted += 8) {
    for (int i = 0; i < 8; ++i) crew.call();
    EXPECT_TRUE(comesTrue([&] { return in_work == wanted; })) << in_work << " of " << wanted;
    EXPECT_TRUE(comesTrue([] { return living == 2; })) << living;
  }
}

TEST(ThreadCrew, LeavesWorkThatComesOneAfterTheOtherToFewThreads) {
  std::mutex mutex;
  std::set<std::thread::id> workers;
  std::atomic<int> done{0};
  ThreadCrew crew({32, live, [&] {
                     {
                       const std::lock_guard<std::mutex> lock(mutex);
                       workers.insert(std::this_thread::get_id());
                     }
                     ++done;
                   }});
  for (int i = 1; i <= 500; ++i) {
    crew.call();
    ASSERT_TRUE(comesTrue([&] { return done == i; }));
  }
  EXPECT_LT(workers.size(), 10U) << "one, and a few more where it had not sat down yet";
}

TEST(ThreadCrew, WaitsForWhatIsInWorkWhenItStops) {
  std::promise<void> began;
  std::atomic<int> done{0};
  ThreadCrew crew({1, live, [&] {
                     if (done == 0) began.set_value();
                     std::this_thread::sleep_for(milliseconds(20));
                     ++done;
                   }});
  crew.call();
  crew.call();
  began.get_future().wait();
  crew.stop();
  EXPECT_EQ(done, 1) << "the second was not begun";
  crew.call();
  crew.stop();
  EXPECT_EQ(done, 1);
  EXPECT_EQ(living, 0);
}

}  // namespace
}  // namespace external_command
