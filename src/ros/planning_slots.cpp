// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_slots.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr std::chrono::milliseconds kCheckPeriod(20);

int coresOrMore(int threads) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return threads > 0 ? threads : std::max(2, cores);
}

void requireWithin(const char* key, int value, int low, int high) {
  if (value < low || value > high) {
    throw InvalidParameter(text(key, " is ", value, "; it must lie in [", low, ", ", high, "]"));
  }
}

}  // namespace

void PlanningLimits::validate() const {
  requireWithin("planning_threads", threads, 0, 256);
  requireWithin("planning_queue", waiting, 0, 1000);
}

PlanningSlots::PlanningSlots(const PlanningLimits& limits)
    : most_dry_runs_(std::max(1, coresOrMore(limits.threads) - 1)), most_waiting_(limits.waiting) {}

std::shared_ptr<PlanningSlots> PlanningSlots::acquire(const PlanningLimits& limits) {
  static std::mutex mutex;
  static std::weak_ptr<PlanningSlots> live;
  const std::lock_guard<std::mutex> lock(mutex);
  auto slots = live.lock();
  if (!slots) live = slots = std::make_shared<PlanningSlots>(limits);
  return slots;
}

PlanningSlots::Slot PlanningSlots::take(Kind kind, const std::function<void()>& check) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!isFree(kind) && waiting(kind) >= most_waiting_) {
    throw NotReady(text("busy: ", commands_, " commands and ", dry_runs_, " dry runs are being planned, ",
                        waiting_commands_, " and ", waiting_dry_runs_,
                        " wait (~planning_threads, ~planning_queue); send it again in a moment"));
  }
  ++waiting(kind);
  try {
    while (!isFree(kind)) {
      changed_.wait_for(lock, kCheckPeriod);
      lock.unlock();
      check();
      lock.lock();
    }
  } catch (...) {
    lock.lock();
    --waiting(kind);
    throw;
  }
  --waiting(kind);
  ++(kind == Kind::kCommand ? commands_ : dry_runs_);
  return {this, kind};
}

bool PlanningSlots::isFree(Kind kind) const {
  if (kind == Kind::kCommand) return commands_ < most_commands_;
  return dry_runs_ < most_dry_runs_ && waiting_commands_ == 0;
}

PlanningSlots::Slot::~Slot() {
  if (slots_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(slots_->mutex_);
  --(kind_ == Kind::kCommand ? slots_->commands_ : slots_->dry_runs_);
  slots_->changed_.notify_all();
}

unsigned PlanningSlots::threadsPerService() const {
  return static_cast<unsigned>(most_commands_ + most_dry_runs_ + 2 * most_waiting_ + 1);
}

}  // namespace external_command
