// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "external_command/ros/executor.h"

namespace external_command {

struct PlanningLimits {
  int threads = 0;  ///< that plan at once; 0: as many as cores, and 2 at least
  int waiting = 6;  ///< commands of a vehicle that may wait for one of them, of all services together, and as many
                    ///< dry runs

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

/// The threads that plan, for all services of one process, below normal priority. Bounds how many requests are planned
/// at once, and how many wait for that: answers come within the planning budget, or "busy" at once.
///
/// Only what is planned runs here. A thread of low priority that is pushed aside while it holds a lock of the gate, of
/// the registry or of roscpp would delay a STOP by as long as it takes to get its turn.
///
/// Two commands may always be in work. Dry runs take what is left of the threads (one at least), and wait behind the
/// commands of their vehicle. Vehicles that share the process take turns: whose turn was longest ago is served next, so
/// that slow plans of one hold up those of another by one plan at most. Thread-safe.
class PlanningPool {
 public:
  enum class Kind { kCommand, kDryRun };

  explicit PlanningPool(const PlanningLimits& limits);

  /// Those of this process: made with `limits` by who asks first, kept by who holds them.
  static std::shared_ptr<PlanningPool> acquire(const PlanningLimits& limits);

  /// The right to plan one request, as long as it lives.
  class Slot {
   public:
    /// Runs `job` on a planning thread and waits for it. What it throws is thrown here.
    void run(const std::function<void()>& job) const;

    /// Runs `part` on the thread that waits in run(), and waits for it: for the part of a job that takes a lock which
    /// a stop takes, too. Runs it on this thread where none waits. What it throws is thrown here.
    void runAtNormalPriority(const std::function<void()>& part) const;

    Slot(Slot&& other) noexcept;
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;
    Slot& operator=(Slot&&) = delete;
    ~Slot();

   private:
    friend class PlanningPool;
    class Parts;
    Slot(PlanningPool* pool, Kind kind);

    PlanningPool* pool_;
    Kind kind_;
    std::unique_ptr<Parts> parts_;
  };

  /// Waits for a slot.
  /// @param vehicle  any name that differs from those of the others of the process.
  /// @param check    called as soon as it has to wait, and now and then while it waits; what it throws ends
  ///                 the waiting.
  /// @throws NotReady  too many of the vehicle wait already.
  Slot take(const std::string& vehicle, Kind kind, const std::function<void()>& check);

  struct Load {
    int commands = 0, dry_runs = 0;  ///< in work
    int waiting_commands = 0, waiting_dry_runs = 0;
  };
  /// Of all vehicles.
  Load load() const;

  /// @throws NotReady  as take()
  void requireRoom(const std::string& vehicle, Kind kind) const;

  /// How many threads of one service may be in here at once: one of them is always there to say "busy".
  unsigned threadsPerService() const;

 private:
  struct Waiting {
    std::string vehicle;
    Kind kind;
    bool is_checked = false;  ///< once; passed over until then, since the first check may take its time
  };
  using Line = std::list<Waiting>;

  void waitForTurn(std::unique_lock<std::mutex>* lock, Line::iterator me, const std::function<void()>& check);
  bool isFree(const std::string& vehicle, Kind kind) const;
  bool isNext(const Waiting& waiting) const;
  void requireRoomLocked(const std::string& vehicle, Kind kind) const;
  int waitingOf(const std::string& vehicle, Kind kind) const;

  const int most_commands_ = 2;
  const int most_dry_runs_;
  const int most_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  int commands_ = 0, dry_runs_ = 0;  ///< in work
  Line line_;                        ///< in the order of their coming
  std::uint64_t turns_ = 0;
  std::map<std::pair<std::string, Kind>, std::uint64_t> last_turns_;  ///< of the vehicles
  Executor executor_;
};

}  // namespace external_command
