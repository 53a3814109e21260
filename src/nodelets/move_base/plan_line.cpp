// SPDX-License-Identifier: Apache-2.0
#include "plan_line.h"

#include <chrono>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr std::chrono::milliseconds kCancelPeriod(10);

}  // namespace

void PlanLine::run(const std::function<void()>& plan) {
  std::unique_lock<std::mutex> lock(mutex_);
  throwIfEndedLocked();
  const std::uint64_t waiting = tickets_ - turn_;
  if (waiting + (is_in_work_ ? 1 : 0) > most_waiting_) {
    throw NotReady(text("busy: a plan is being made and ", waiting,
                        " requests wait for theirs, which is the most; ask again when one was answered"));
  }
  const std::uint64_t ticket = tickets_++;
  changed_.wait(lock, [&] { return is_ended_ || (ticket == turn_ && !is_in_work_); });
  throwIfEndedLocked();
  ++turn_;
  is_in_work_ = true;
  lock.unlock();
  const auto leave = [this] {
    const std::lock_guard<std::mutex> relock(mutex_);
    is_in_work_ = false;
    changed_.notify_all();
  };
  try {
    plan();
  } catch (...) {
    leave();
    throw;
  }
  leave();
}

std::uint64_t PlanLine::waiting() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return tickets_ - turn_;
}

void PlanLine::throwIfEnded() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  throwIfEndedLocked();
}

void PlanLine::throwIfEndedLocked() const {
  if (is_ended_) throw Cancelled("what makes the plan is being unloaded");
}

void PlanLine::end(const std::function<void()>& cancel) {
  std::unique_lock<std::mutex> lock(mutex_);
  is_ended_ = true;
  changed_.notify_all();
  while (is_in_work_) {
    lock.unlock();
    cancel();
    lock.lock();
    changed_.wait_for(lock, kCancelPeriod, [this] { return !is_in_work_; });
  }
}

}  // namespace external_command
