// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_pool.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
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

constexpr const char* kVehicle = "/apollo";
constexpr const char* kOther = "/other";

/// Ends a waiting at once: shows that there was one.
struct HadToWait {};
void giveUp() { throw HadToWait(); }

TEST(PlanningPool, PlansTwoCommandsAtOnce) {
  PlanningPool pool(limits(2, 1));
  const auto older = pool.take(kVehicle, Kind::kCommand, giveUp);
  const auto newer = pool.take(kVehicle, Kind::kCommand, giveUp);
  EXPECT_THROW(pool.take(kVehicle, Kind::kCommand, giveUp), HadToWait);
}

TEST(PlanningPool, IsAlwaysThereForACommandWhateverDryRunsAreInWork) {
  PlanningPool pool(limits(4, 1));
  const auto a = pool.take(kVehicle, Kind::kDryRun, giveUp);
  const auto b = pool.take(kVehicle, Kind::kDryRun, giveUp);
  const auto c = pool.take(kVehicle, Kind::kDryRun, giveUp);
  EXPECT_THROW(pool.take(kVehicle, Kind::kDryRun, giveUp), HadToWait);
  EXPECT_NO_THROW(pool.take(kVehicle, Kind::kCommand, giveUp));
}

TEST(PlanningPool, AnswersBusyAtOnceBeyondThoseThatMayWait) {
  PlanningPool pool(limits(2, 1));
  std::optional<PlanningPool::Slot> in_work(pool.take(kVehicle, Kind::kDryRun, giveUp));
  std::promise<void> waits;
  std::atomic<bool> has_told{false};
  auto waiting = std::async(std::launch::async, [&] {
    pool.take(kVehicle, Kind::kDryRun, [&] {
      if (!has_told.exchange(true)) waits.set_value();
    });
  });
  waits.get_future().wait();
  EXPECT_THROW(pool.requireRoom(kVehicle, Kind::kDryRun), NotReady);
  EXPECT_NO_THROW(pool.requireRoom(kVehicle, Kind::kCommand));
  EXPECT_EQ(pool.load().dry_runs, 1);
  EXPECT_EQ(pool.load().waiting_dry_runs, 1);
  try {
    pool.take(kVehicle, Kind::kDryRun, [] { FAIL() << "it must not wait"; });
    FAIL() << "it must be refused";
  } catch (const NotReady& error) {
    EXPECT_NE(std::string(error.what()).find("busy"), std::string::npos) << error.what();
  }
  in_work.reset();
  waiting.get();
}

TEST(PlanningPool, LetsDryRunsWaitBehindCommands) {
  PlanningPool pool(limits(2, 2));
  std::optional<PlanningPool::Slot> first(pool.take(kVehicle, Kind::kCommand, giveUp));
  std::optional<PlanningPool::Slot> second(pool.take(kVehicle, Kind::kCommand, giveUp));
  std::promise<void> waits;
  std::atomic<bool> has_told{false};
  auto command = std::async(std::launch::async, [&] {
    pool.take(kVehicle, Kind::kCommand, [&] {
      if (!has_told.exchange(true)) waits.set_value();
    });
  });
  waits.get_future().wait();
  EXPECT_THROW(pool.take(kVehicle, Kind::kDryRun, giveUp), HadToWait);
  first.reset();
  command.get();
  EXPECT_NO_THROW(pool.take(kVehicle, Kind::kDryRun, giveUp));
}

/// Requests of several vehicles that wait, each in a thread of its own.
class WaitingRequests {
 public:
  WaitingRequests(PlanningPool* pool, Kind kind) : pool_(pool), kind_(kind) {}

  /// Returns when it waits and has its place in the line, which it has once its first check is over: before the second.
  void add(const std::string& vehicle) {
    const auto waits = std::make_shared<std::promise<void>>();
    served_.push_back(std::async(std::launch::async, [this, vehicle, waits, checks = 0]() mutable {
      const auto slot = pool_->take(vehicle, kind_, [&] {
        if (++checks == 2) waits->set_value();
      });
      const std::lock_guard<std::mutex> lock(mutex_);
      order_.push_back(vehicle);
    }));
    waits->get_future().wait();
  }

  std::vector<std::string> order() {
    for (auto& served : served_) served.get();
    return order_;
  }

 private:
  PlanningPool* pool_;
  Kind kind_;
  std::mutex mutex_;
  std::vector<std::string> order_;
  std::vector<std::future<void>> served_;
};

TEST(PlanningPool, LetsVehiclesTakeTurnsWhicheverHasMoreToPlan) {
  for (const Kind kind : {Kind::kCommand, Kind::kDryRun}) {
    PlanningPool pool(limits(2, 6));
    std::vector<PlanningPool::Slot> in_work;
    for (int i = 0; i < (kind == Kind::kCommand ? 2 : 1); ++i) in_work.push_back(pool.take(kVehicle, kind, giveUp));
    WaitingRequests waiting(&pool, kind);
    for (int i = 0; i < 3; ++i) waiting.add(kVehicle);
    for (int i = 0; i < 2; ++i) waiting.add(kOther);
    in_work.pop_back();
    EXPECT_EQ(waiting.order(), std::vector<std::string>({kOther, kVehicle, kOther, kVehicle, kVehicle}));
  }
}

TEST(PlanningPool, RefusesAVehicleForNoneOfTheRequestsOfAnother) {
  PlanningPool pool(limits(2, 1));
  std::optional<PlanningPool::Slot> in_work(pool.take(kVehicle, Kind::kDryRun, giveUp));
  WaitingRequests waiting(&pool, Kind::kDryRun);
  waiting.add(kVehicle);
  EXPECT_THROW(pool.requireRoom(kVehicle, Kind::kDryRun), NotReady);
  EXPECT_NO_THROW(pool.requireRoom(kOther, Kind::kDryRun));
  EXPECT_THROW(pool.take(kOther, Kind::kDryRun, giveUp), HadToWait) << "it may wait";
  in_work.reset();
  EXPECT_EQ(waiting.order().size(), 1u);
}

TEST(PlanningPool, LetsTheNextOneInWhereAWaitingOneTakesItsTimeToCheck) {
  PlanningPool pool(limits(2, 2));
  std::optional<PlanningPool::Slot> in_work(pool.take(kVehicle, Kind::kDryRun, giveUp));
  std::promise<void> checks, goes_on;
  auto slow = std::async(std::launch::async, [&, has_told = false]() mutable {
    pool.take(kVehicle, Kind::kDryRun, [&] {
      if (std::exchange(has_told, true)) return;
      checks.set_value();
      goes_on.get_future().wait();
    });
  });
  checks.get_future().wait();
  in_work.reset();
  EXPECT_NO_THROW(pool.take(kOther, Kind::kDryRun, giveUp));
  goes_on.set_value();
  slow.get();
}

TEST(PlanningPool, PlansOnThreadsOfItsOwnBelowNormalPriority) {
  const int normal = getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)));
  if (normal >= 19) GTEST_SKIP() << "nothing is below the priority of this process";
  PlanningPool pool(limits(2, 1));
  std::thread::id planner;
  int niceness = 0;
  pool.take(kVehicle, Kind::kCommand, giveUp).run([&] {
    planner = std::this_thread::get_id();
    niceness = getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)));
  });
  EXPECT_NE(planner, std::this_thread::get_id());
  EXPECT_GT(niceness, normal);
}

TEST(PlanningPool, HandsOverWhatThePlanningThrows) {
  PlanningPool pool(limits(2, 1));
  const auto slot = pool.take(kVehicle, Kind::kCommand, giveUp);
  EXPECT_THROW(slot.run([] { throw NotReady("no pose"); }), NotReady);
  EXPECT_NO_THROW(slot.run([] {}));
}

TEST(PlanningPool, RunsPartsOfAPlanOnTheThreadThatWaitsForIt) {
  PlanningPool pool(limits(2, 1));
  const auto slot = pool.take(kVehicle, Kind::kCommand, giveUp);
  std::vector<std::thread::id> threads;
  const auto note = [&] { threads.push_back(std::this_thread::get_id()); };
  slot.run([&] {
    for (int i = 0; i < 1000; ++i) slot.runAtNormalPriority(note);
  });
  slot.runAtNormalPriority(note);
  EXPECT_EQ(threads, std::vector<std::thread::id>(1001, std::this_thread::get_id()));
}

TEST(PlanningPool, HandsAPlanWhatItsPartsThrow) {
  PlanningPool pool(limits(2, 1));
  const auto slot = pool.take(kVehicle, Kind::kCommand, giveUp);
  int thrown = 0;
  slot.run([&] {
    try {
      slot.runAtNormalPriority([] { throw NotReady("no pose"); });
    } catch (const NotReady&) {
      ++thrown;
    }
  });
  EXPECT_EQ(thrown, 1);
  EXPECT_THROW(slot.run([&] { slot.runAtNormalPriority([] { throw NotReady("no pose"); }); }), NotReady);
  EXPECT_THROW(slot.runAtNormalPriority([] { throw NotReady("no pose"); }), NotReady);
  EXPECT_NO_THROW(slot.run([&] { slot.runAtNormalPriority([] {}); }));
}

TEST(PlanningPool, ForgetsWhoGaveUpWaiting) {
  PlanningPool pool(limits(2, 1));
  const auto in_work = pool.take(kVehicle, Kind::kDryRun, giveUp);
  for (int i = 0; i < 3; ++i) EXPECT_THROW(pool.take(kVehicle, Kind::kDryRun, giveUp), HadToWait) << i;
}

TEST(PlanningPool, RefusesLimitsOutOfRange) {
  EXPECT_NO_THROW(limits(0, 0).validate());
  EXPECT_THROW(limits(-1, 0).validate(), InvalidParameter);
  EXPECT_THROW(limits(1, 1001).validate(), InvalidParameter);
}

}  // namespace
}  // namespace external_command
