// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/planning_pool.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

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

PlanningPool::Slot PlanningPool::take(const std::string& vehicle, Kind kind, const std::function<void()>& check) {
  std::unique_lock<std::mutex> lock(mutex_);
  requireRoomLocked(vehicle, kind);
  const auto me = line_.insert(line_.end(), {vehicle, kind});
  try {
    waitForTurn(&lock, me, check);
  } catch (...) {
    if (!lock.owns_lock()) lock.lock();
    line_.erase(me);
    changed_.notify_all();
    throw;
  }
  line_.erase(me);
  last_turns_[{vehicle, kind}] = ++turns_;
  ++(kind == Kind::kCommand ? commands_ : dry_runs_);
  changed_.notify_all();
  return Slot(this, kind);
}

void PlanningPool::waitForTurn(std::unique_lock<std::mutex>* lock, Line::iterator me,
                               const std::function<void()>& check) {
  const auto checkUnlocked = [&] {
    lock->unlock();
    check();
    lock->lock();
  };
  if (isNext(*me)) return;
  checkUnlocked();
  me->is_checked = true;
  while (!isNext(*me)) {
    changed_.wait_for(*lock, kCheckPeriod);
    checkUnlocked();
  }
}

bool PlanningPool::isFree(const std::string& vehicle, Kind kind) const {
  if (kind == Kind::kCommand) return commands_ < most_commands_;
  return dry_runs_ < most_dry_runs_ && waitingOf(vehicle, Kind::kCommand) == 0;
}

/// Among those of one turn, the first that came.
bool PlanningPool::isNext(const Waiting& waiting) const {
  if (!isFree(waiting.vehicle, waiting.kind)) return false;
  const auto lastTurn = [this](const Waiting& other) {
    const auto found = last_turns_.find({other.vehicle, other.kind});
    return found == last_turns_.end() ? 0 : found->second;
  };
  const std::uint64_t mine = lastTurn(waiting);
  bool came_earlier = true;
  for (const Waiting& other : line_) {
    if (&other == &waiting) {
      came_earlier = false;
      continue;
    }
    if (other.kind != waiting.kind || !other.is_checked || !isFree(other.vehicle, other.kind)) continue;
    const std::uint64_t theirs = lastTurn(other);
    if (theirs < mine || (theirs == mine && came_earlier)) return false;
  }
  return true;
}

int PlanningPool::waitingOf(const std::string& vehicle, Kind kind) const {
  return static_cast<int>(std::count_if(line_.begin(), line_.end(), [&](const Waiting& waiting) {
    return waiting.kind == kind && waiting.vehicle == vehicle;
  }));
}

void PlanningPool::requireRoomLocked(const std::string& vehicle, Kind kind) const {
  if (isFree(vehicle, kind) || waitingOf(vehicle, kind) < most_waiting_) return;
  throw NotReady(text("busy: ", commands_, " commands and ", dry_runs_, " dry runs are being planned, ",
                      waitingOf(vehicle, Kind::kCommand), " and ", waitingOf(vehicle, Kind::kDryRun),
                      " of this vehicle wait (~planning_threads, ~planning_queue); send it again in a moment"));
}

void PlanningPool::requireRoom(const std::string& vehicle, Kind kind) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireRoomLocked(vehicle, kind);
}

PlanningPool::Load PlanningPool::load() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Load load{commands_, dry_runs_, 0, 0};
  for (const Waiting& waiting : line_) {
    ++(waiting.kind == Kind::kCommand ? load.waiting_commands : load.waiting_dry_runs);
  }
  return load;
}

/// What a job leaves to the thread that waits for it.
class PlanningPool::Slot::Parts {
 public:
  /// From now on parts are left to who calls serve().
  void open() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_open_ = true;
  }

  /// Runs parts until the job has ended. @return  what the job threw; nullptr where it threw nothing.
  std::exception_ptr serve() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return part_ != nullptr || !is_open_; });
      if (part_ == nullptr) return std::exchange(fault_, nullptr);
      lock.unlock();
      const std::exception_ptr fault = faultOf(*part_);
      lock.lock();
      fault_ = fault;
      part_ = nullptr;
      changed_.notify_all();
    }
  }

  /// Ends serve(). To be called by the job's thread, as run() is.
  void close(const std::exception_ptr& fault) {
    const std::lock_guard<std::mutex> lock(mutex_);
    fault_ = fault;
    is_open_ = false;
    changed_.notify_all();
  }

  void run(const std::function<void()>& part) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!is_open_) {
      lock.unlock();
      part();
      return;
    }
    part_ = &part;
    changed_.notify_all();
    changed_.wait(lock, [this] { return part_ == nullptr; });
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  }

  static std::exception_ptr faultOf(const std::function<void()>& work) {
    try {
      work();
      return nullptr;
    } catch (...) {
      return std::current_exception();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_open_ = false;
  const std::function<void()>* part_ = nullptr;  ///< to be run
  std::exception_ptr fault_;
};

PlanningPool::Slot::Slot(PlanningPool* pool, Kind kind) : pool_(pool), kind_(kind), parts_(std::make_unique<Parts>()) {}

PlanningPool::Slot::Slot(Slot&& other) noexcept
    : pool_(std::exchange(other.pool_, nullptr)), kind_(other.kind_), parts_(std::move(other.parts_)) {}

void PlanningPool::Slot::run(const std::function<void()>& job) const {
  parts_->open();
  pool_->executor_.post([this, &job] { parts_->close(Parts::faultOf(job)); });
  if (const std::exception_ptr fault = parts_->serve()) std::rethrow_exception(fault);
}

void PlanningPool::Slot::runAtNormalPriority(const std::function<void()>& part) const { parts_->run(part); }

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
