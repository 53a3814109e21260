// SPDX-License-Identifier: Apache-2.0
#include "nodelets/move_base/plan_line.h"

#include <gtest/gtest.h>

#include <future>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "external_command/core/error.h"

namespace external_command {
namespace {

/// A line in which two may wait, with a plan in work that ends when the test lets it.
class BusyPlanLine : public testing::Test {
 protected:
  void SetUp() override {
    std::promise<void> entered;
    in_work_ = std::async(std::launch::async, [&] {
      line_.run([&] {
        entered.set_value();
        leave_.get_future().wait();
      });
    });
    entered.get_future().wait();
  }

  void TearDown() override {
    if (in_work_.valid()) letGo();
  }

  void letGo() {
    leave_.set_value();
    in_work_.get();
  }

  /// Returns when it waits for its turn.
  std::future<void> ask(int number) {
    const std::uint64_t before = line_.waiting();
    auto asked = std::async(std::launch::async, [this, number] {
      line_.run([this, number] {
        const std::lock_guard<std::mutex> lock(mutex_);
        served_.push_back(number);
      });
    });
    while (line_.waiting() == before) std::this_thread::yield();
    return asked;
  }

  PlanLine line_{2};
  std::promise<void> leave_;
  std::future<void> in_work_;
  std::mutex mutex_;
  std::vector<int> served_;
};

TEST_F(BusyPlanLine, ServesThoseThatWaitInTheOrderOfTheirComing) {
  auto first = ask(1), second = ask(2);
  letGo();
  first.get();
  second.get();
  EXPECT_EQ(served_, std::vector<int>({1, 2}));
  EXPECT_EQ(line_.waiting(), 0u);
}

TEST_F(BusyPlanLine, RefusesWhatIsBeyondThoseThatMayWait) {
  auto first = ask(1), second = ask(2);
  try {
    line_.run([] { FAIL() << "it must not be its turn"; });
    FAIL() << "it must be refused";
  } catch (const NotReady& error) {
    EXPECT_NE(std::string(error.what()).find("busy"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("2 requests"), std::string::npos) << error.what();
  }
  letGo();
  first.get();
  second.get();
  EXPECT_NO_THROW(line_.run([] {}));
}

TEST_F(BusyPlanLine, EndsWhatWaitsAndCancelsWhatIsInWorkUntilItHasLeft) {
  auto waiting = ask(1);
  int cancels = 0;
  line_.end([&] {
    if (++cancels == 3) letGo();  // as one that begins only after it was cancelled first
  });
  EXPECT_EQ(cancels, 3);
  EXPECT_THROW(waiting.get(), Cancelled);
  EXPECT_THROW(line_.run([] {}), Cancelled);
  EXPECT_THROW(line_.throwIfEnded(), Cancelled);
  EXPECT_TRUE(served_.empty());
}

TEST(PlanLine, EndsAtOnceWhereNothingIsInWork) {
  PlanLine line(2);
  EXPECT_NO_THROW(line.throwIfEnded());
  line.end([] { FAIL() << "there is nothing to cancel"; });
}

TEST(PlanLine, GoesOnAfterAPlanThatThrew) {
  PlanLine line(0);
  EXPECT_THROW(line.run([] { throw NoPath("none"); }), NoPath);
  EXPECT_NO_THROW(line.run([] {}));
}

}  // namespace
}  // namespace external_command
