// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_pool.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <thread>

#include "external_command/core/error.h"
#include "external_command/core/parameter_range.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr std::chrono::milliseconds kCheckPeriod(20);

int coresOrMore(int threads) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return threads > 0 ? threads : std::max(2, cores);
}

}  // namespace

void PlanningLimits::validate() const {
  requireParameter("planning_threads", threads, 0, 256);
  requireParameter("planning_queue", waiting, 0, 1000);
}

PlanningPool::PlanningPool(const PlanningLimits& limits)
    : most_dry_runs_(std::max(1, coresOrMore(limits.threads) - 1)),
      most_waiting_(limits.waiting),
      executor_(ExecutorOptions{"the planning threads", static_cast<unsigned>(most_commands_ + most_dry_runs_),
                                ExecutorPriority::kBackground}) {}

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
  requireRoomLocked(kind);
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
  ++(kind == Kind::kCommand ? load_.commands : load_.dry_runs);
  return {this, kind};
}

bool PlanningPool::isFree(Kind kind) const {
  if (kind == Kind::kCommand) return load_.commands < most_commands_;
  return load_.dry_runs < most_dry_runs_ && load_.waiting_commands == 0;
}

void PlanningPool::requireRoomLocked(Kind kind) const {
  const int waiting = kind == Kind::kCommand ? load_.waiting_commands : load_.waiting_dry_runs;
  if (isFree(kind) || waiting < most_waiting_) return;
  throw NotReady(text("busy: ", load_.commands, " commands and ", load_.dry_runs, " dry runs are being planned, ",
                      load_.waiting_commands, " and ", load_.waiting_dry_runs,
                      " wait (~planning_threads, ~planning_queue); send it again in a moment"));
}

void PlanningPool::requireRoom(Kind kind) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireRoomLocked(kind);
}

PlanningPool::Load PlanningPool::load() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return load_;
}

void PlanningPool::Slot::run(const std::function<void()>& job) const {
  std::packaged_task<void()> task(job);
  pool_->executor_.post([&task] { task(); });
  task.get_future().get();
}

PlanningPool::Slot::~Slot() {
  if (pool_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(pool_->mutex_);
  --(kind_ == Kind::kCommand ? pool_->load_.commands : pool_->load_.dry_runs);
  pool_->changed_.notify_all();
}

unsigned PlanningPool::threadsPerService() const {
  return static_cast<unsigned>(most_commands_ + most_dry_runs_ + 2 * most_waiting_ + 1);
}

}  // namespace external_command
