// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_slots.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <optional>
#include <vector>

#include "external_command/core/error.h"

namespace external_command {
namespace {

using Kind = PlanningSlots::Kind;

PlanningLimits limits(int threads, int waiting) {
  PlanningLimits made;
  made.threads = threads;
  made.waiting = waiting;
  return made;
}

/// Ends a waiting at once: shows that there was one.
struct HadToWait {};
void giveUp() { throw HadToWait(); }

TEST(PlanningSlots, LetTheCommandInThatCancelsTheOneInWork) {
  PlanningSlots slots(limits(2, 1));
  const auto older = slots.take(Kind::kCommand, giveUp);
  const auto newer = slots.take(Kind::kCommand, giveUp);
  EXPECT_THROW(slots.take(Kind::kCommand, giveUp), HadToWait);
}

TEST(PlanningSlots, AreAlwaysThereForACommandWhateverDryRunsAreInWork) {
  PlanningSlots slots(limits(4, 1));
  const auto a = slots.take(Kind::kDryRun, giveUp);
  const auto b = slots.take(Kind::kDryRun, giveUp);
  const auto c = slots.take(Kind::kDryRun, giveUp);
  EXPECT_THROW(slots.take(Kind::kDryRun, giveUp), HadToWait);
  EXPECT_NO_THROW(slots.take(Kind::kCommand, giveUp));
}

TEST(PlanningSlots, AnswerBusyAtOnceBeyondThoseThatMayWait) {
  PlanningSlots slots(limits(2, 1));
  std::optional<PlanningSlots::Slot> in_work(slots.take(Kind::kDryRun, giveUp));
  std::promise<void> waits;
  std::atomic<bool> has_told{false};
  auto waiting = std::async(std::launch::async, [&] {
    slots.take(Kind::kDryRun, [&] {
      if (!has_told.exchange(true)) waits.set_value();
    });
  });
  waits.get_future().wait();
  try {
    slots.take(Kind::kDryRun, [] { FAIL() << "it must not wait"; });
    FAIL() << "it must be refused";
  } catch (const NotReady& error) {
    EXPECT_NE(std::string(error.what()).find("busy"), std::string::npos) << error.what();
  }
  in_work.reset();
  waiting.get();
}

TEST(PlanningSlots, LetDryRunsWaitBehindCommands) {
  PlanningSlots slots(limits(2, 2));
  std::optional<PlanningSlots::Slot> first(slots.take(Kind::kCommand, giveUp));
  std::optional<PlanningSlots::Slot> second(slots.take(Kind::kCommand, giveUp));
  std::promise<void> waits;
  std::atomic<bool> has_told{false};
  auto command = std::async(std::launch::async, [&] {
    slots.take(Kind::kCommand, [&] {
      if (!has_told.exchange(true)) waits.set_value();
    });
  });
  waits.get_future().wait();
  EXPECT_THROW(slots.take(Kind::kDryRun, giveUp), HadToWait);
  first.reset();
  command.get();
  EXPECT_NO_THROW(slots.take(Kind::kDryRun, giveUp));
}

TEST(PlanningSlots, ForgetWhoGaveUpWaiting) {
  PlanningSlots slots(limits(2, 1));
  const auto in_work = slots.take(Kind::kDryRun, giveUp);
  for (int i = 0; i < 3; ++i) EXPECT_THROW(slots.take(Kind::kDryRun, giveUp), HadToWait) << i;
}

TEST(PlanningSlots, RefuseLimitsOutOfRange) {
  EXPECT_NO_THROW(limits(0, 0).validate());
  EXPECT_THROW(limits(-1, 0).validate(), InvalidParameter);
  EXPECT_THROW(limits(1, 1001).validate(), InvalidParameter);
}

}  // namespace
}  // namespace external_command
