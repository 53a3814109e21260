// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_pool.h"

#include <algorithm>
#include <chrono>
#include <future>
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

PlanningPool::PlanningPool(const PlanningLimits& limits)
    : most_dry_runs_(std::max(1, coresOrMore(limits.threads) - 1)),
      most_waiting_(limits.waiting),
      lane_(LaneOptions{"the planning threads", static_cast<unsigned>(most_commands_ + most_dry_runs_),
                        LanePriority::kBackground}) {}

std::shared_ptr<PlanningPool> PlanningPool::acquire(const PlanningLimits& limits) {
  static std::mutex mutex;
  static std::weak_ptr<PlanningPool> live;
  const std::lock_guard<std::mutex> lock(mutex);
  auto pool = live.lock();
  if (!pool) live = pool = std::make_shared<PlanningPool>(limits);
  return pool;
}

PlanningPool::Slot PlanningPool::take(Kind kind, const std::function<void()>& check) {
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

bool PlanningPool::isFree(Kind kind) const {
  if (kind == Kind::kCommand) return commands_ < most_commands_;
  return dry_runs_ < most_dry_runs_ && waiting_commands_ == 0;
}

void PlanningPool::Slot::run(const std::function<void()>& job) const {
  std::packaged_task<void()> task(job);
  pool_->lane_.post([&task] { task(); });
  task.get_future().get();
}

PlanningPool::Slot::~Slot() {
  if (pool_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(pool_->mutex_);
  --(kind_ == Kind::kCommand ? pool_->commands_ : pool_->dry_runs_);
  pool_->changed_.notify_all();
}

unsigned PlanningPool::threadsPerService() const {
  return static_cast<unsigned>(most_commands_ + most_dry_runs_ + 2 * most_waiting_ + 1);
}

}  // namespace external_command
