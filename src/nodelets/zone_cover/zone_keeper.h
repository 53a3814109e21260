// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "external_command/ros/executor.h"
#include "external_command/ros/log_writer.h"
#include "zone_plan_file.h"

namespace external_command {

/// Writes zones' files on a thread of its own, so that a slow disk delays nobody: once a second each and when that is
/// asked for, less often where a write takes long, but always a second after the vehicle came to a stop. What cannot be
/// written is kept in memory and tried again.
/// Thread-safe.
class ZoneKeeper {
 public:
  /// A new plan, on the disk under a temporary name until it is adopted: a command that is not sent replaces nothing.
  /// What is not adopted is removed with it. To be gone before the keeper is.
  class Draft {
   public:
    ~Draft();
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    /// Why it is not on the disk; empty where it is.
    std::string failure() const;

   private:
    friend class ZoneKeeper;
    struct State;
    Draft(ZoneKeeper* keeper, std::shared_ptr<State> state) : keeper_(*keeper), state_(std::move(state)) {}

    ZoneKeeper& keeper_;
    const std::shared_ptr<State> state_;
  };

  ZoneKeeper();
  ~ZoneKeeper();  ///< writes what is not written yet

  /// Waits for the disk, a second at most.
  std::unique_ptr<Draft> draft(const ZonePlanFile& file, const CoverageProgress& progress);

  /// The draft becomes its zone's file.
  void adopt(const Draft& draft);

  /// What is swept now of the zone of the file `path`, which was adopted. Does not wait.
  /// @param at_once  it is written before its second is over.
  void note(const std::string& path, const CoverageProgress& progress, bool at_once);

  /// The zone is swept no more: the last that was noted is written at once.
  void finish(const std::string& path);

  /// To be called a few times per second: writes what is due.
  void tick();

  /// Why the progress of the zone is not on the disk; empty where it is, or soon will be.
  std::string failureOf(const std::string& path) const;

  /// What is known of the zone and the disk does not have, after waiting for it half a second at most; nullopt where
  /// the disk has all.
  std::optional<CoverageProgress> unwritten(const std::string& path);

 private:
  using Clock = std::chrono::steady_clock;
  struct Kept;

  void post(const std::shared_ptr<Kept>& kept);
  void write(const std::shared_ptr<Kept>& kept);
  void place(const std::shared_ptr<Kept>& kept, const std::shared_ptr<Draft::State>& draft);
  void settle(const std::shared_ptr<Kept>& kept, const std::string& failure, Clock::duration took);
  void forgetOldest();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, std::shared_ptr<Kept>> kept_;  ///< by the files' paths
  LogThrottle warnings_{10.0};                         ///< one per that many seconds
  Executor executor_{ExecutorOptions{"the executor of the zones' files"}};
};

}  // namespace external_command
