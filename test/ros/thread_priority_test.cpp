// SPDX-License-Identifier: Apache-2.0
#include "ros/thread_priority.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

namespace external_command {
namespace {

constexpr int kLowest = 19;  ///< priority that there is, as niceness

int nicenessOfThisThread() { return getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid))); }

/// Of a new thread that lowers its own, twice [0, 19].
int loweredNiceness() {
  int niceness = 0;
  std::thread([&] {
    lowerThreadPriority();
    lowerThreadPriority();
    niceness = nicenessOfThisThread();
  }).join();
  return niceness;
}

TEST(ThreadPriority, IsBelowThatOfTheProcess) {
  if (nicenessOfThisThread() >= kLowest) GTEST_SKIP() << "nothing is below the priority of this process";
  EXPECT_GT(loweredNiceness(), nicenessOfThisThread());
}

TEST(ThreadPriority, IsBelowThatOfAProcessThatWasStartedNice) {
  if (nicenessOfThisThread() > 0) GTEST_SKIP() << "this process was started nice, as the other tests show";
  const auto lowersBy = [](int niceness) {
    if (nice(niceness) < 0) std::exit(2);
    std::exit(loweredNiceness() > nicenessOfThisThread() ? 0 : 1);
  };
  EXPECT_EXIT(lowersBy(12), testing::ExitedWithCode(0), "");
}

TEST(ThreadPriority, IsNoTroubleWhereItCannotBeLower) {
  const auto staysAt = [](int niceness) {
    if (nice(niceness) < 0) std::exit(2);
    std::exit(loweredNiceness() == niceness ? 0 : 1);
  };
  EXPECT_EXIT(staysAt(kLowest), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace external_command
