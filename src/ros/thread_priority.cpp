// SPDX-License-Identifier: Apache-2.0
#include "thread_priority.h"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>

namespace external_command {

namespace {

constexpr int kMoreNiceness = 10;  // than that of the process: it may have been started with another than 0
constexpr int kMostNiceness = 19;

}  // namespace

void lowerThreadPriority() {
  const int normal = getpriority(PRIO_PROCESS, static_cast<id_t>(getpid()));
  const int lowered = std::min(normal + kMoreNiceness, kMostNiceness);
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), lowered);
}

void raiseThreadPriority() {
  sched_param parameters{};
  parameters.sched_priority = sched_get_priority_min(SCHED_RR);
  pthread_setschedparam(pthread_self(), SCHED_RR, &parameters);
}

}  // namespace external_command
