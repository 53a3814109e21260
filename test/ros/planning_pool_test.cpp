// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_pool.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <future>
#include <optional>
#include <thread>
#include <vector>

#include "external_command/core/error.h"

namespace external_command {
namespace {

using Kind = PlanningPool::Kind;

PlanningLimits limits(int threads, int waiting) {
  PlanningLimits made;
  made.threads = threads;
  made.waiting = waiting;
  return made;
}

/// Ends a waiting at once: shows that there was one.
struct HadToWait {};
void giveUp() { throw HadToWait(); }

TEST(PlanningPool, LetsTheCommandInThatCancelsTheOneInWork) {
  PlanningPool pool(limits(2, 1));
  const auto older = pool.take(Kind::kCommand, giveUp);
  const auto newer = pool.take(Kind::kCommand, giveUp);
  EXPECT_THROW(pool.take(Kind::kCommand, giveUp), HadToWait);
}

TEST(PlanningPool, IsAlwaysThereForACommandWhateverDryRunsAreInWork) {
  PlanningPool pool(limits(4, 1));
  const auto a = pool.take(Kind::kDryRun, giveUp);
  const auto b = pool.take(Kind::kDryRun, giveUp);
  const auto c = pool.take(Kind::kDryRun, giveUp);
  EXPECT_THROW(pool.take(Kind::kDryRun, giveUp), HadToWait);
  EXPECT_NO_THROW(pool.take(Kind::kCommand, giveUp));
}

TEST(PlanningPool, AnswersBusyAtOnceBeyondThoseThatMayWait) {
  PlanningPool pool(limits(2, 1));
  std::optional<PlanningPool::Slot> in_work(pool.take(Kind::kDryRun, giveUp));
  std::promise<void> waits;
  std::atomic<bool> has_told{false};
  auto waiting = std::async(std::launch::async, [&] {
    pool.take(Kind::kDryRun, [&] {
      if (!has_told.exchange(true)) waits.set_value();
    });
  });
  waits.get_future().wait();
  EXPECT_THROW(pool.requireRoom(Kind::kDryRun), NotReady);
  EXPECT_NO_THROW(pool.requireRoom(Kind::kCommand));
  EXPECT_EQ(pool.load().dry_runs, 1);
  EXPECT_EQ(pool.load().waiting_dry_runs, 1);
  try {
    pool.take(Kind::kDryRun, [] { FAIL() << "it must not wait"; });
    FAIL() << "it must be refused";
  } catch (const NotReady& error) {
    EXPECT_NE(std::string(error.what()).find("busy"), std::string::npos) << error.what();
  }
  in_work.reset();
  waiting.get();
}

TEST(PlanningPool, LetsDryRunsWaitBehindCommands) {
  PlanningPool pool(limits(2, 2));
  std::optional<PlanningPool::Slot> first(pool.take(Kind::kCommand, giveUp));
  std::optional<PlanningPool::Slot> second(pool.take(Kind::kCommand, giveUp));
  std::promise<void> waits;
  std::atomic<bool> has_told{false};
  auto command = std::async(std::launch::async, [&] {
    pool.take(Kind::kCommand, [&] {
      if (!has_told.exchange(true)) waits.set_value();
    });
  });
  waits.get_future().wait();
  EXPECT_THROW(pool.take(Kind::kDryRun, giveUp), HadToWait);
  first.reset();
  command.get();
  EXPECT_NO_THROW(pool.take(Kind::kDryRun, giveUp));
}

TEST(PlanningPool, PlansOnThreadsOfItsOwnBelowNormalPriority) {
  const int normal = getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)));
  if (normal >= 19) GTEST_SKIP() << "nothing is below the priority of this process";
  PlanningPool pool(limits(2, 1));
  std::thread::id planner;
  int niceness = 0;
  pool.take(Kind::kCommand, giveUp).run([&] {
    planner = std::this_thread::get_id();
    niceness = getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)));
  });
  EXPECT_NE(planner, std::this_thread::get_id());
  EXPECT_GT(niceness, normal);
}

TEST(PlanningPool, HandsOverWhatThePlanningThrows) {
  PlanningPool pool(limits(2, 1));
  const auto slot = pool.take(Kind::kCommand, giveUp);
  EXPECT_THROW(slot.run([] { throw NotReady("no pose"); }), NotReady);
  EXPECT_NO_THROW(slot.run([] {}));
}

TEST(PlanningPool, ForgetsWhoGaveUpWaiting) {
  PlanningPool pool(limits(2, 1));
  const auto in_work = pool.take(Kind::kDryRun, giveUp);
  for (int i = 0; i < 3; ++i) EXPECT_THROW(pool.take(Kind::kDryRun, giveUp), HadToWait) << i;
}

TEST(PlanningPool, RefusesLimitsOutOfRange) {
  EXPECT_NO_THROW(limits(0, 0).validate());
  EXPECT_THROW(limits(-1, 0).validate(), InvalidParameter);
  EXPECT_THROW(limits(1, 1001).validate(), InvalidParameter);
}

}  // namespace
}  // namespace external_command
