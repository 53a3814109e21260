// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue_interface.h>

#include <functional>
#include <memory>

namespace external_command {

/// Calls a job on the threads of a queue again and again, for as long as it lives: first after one period, and not
/// again while a call waits or runs late. By a clock that never jumps.
///
/// All of a process share one thread that keeps the time. roscpp's timers do so too, but at every tick they sort all
/// timers by looking each of them up in a list: a thousand of them, as fifty vehicles have, keep a processor busy.
class Periodic {
 public:
  Periodic() = default;  ///< calls nothing

  /// Whether there is anything to do: where not, no thread is woken for the call. Asked by the thread that keeps the
  /// time for all, so it must not wait.
  using Wanted = std::function<bool()>;

  /// @param period  above 0 [s]
  /// @param queue   must live as long as this.
  /// @param wanted  empty: always.
  Periodic(double period, ros::CallbackQueueInterface* queue, std::function<void()> job, Wanted wanted = {});

  Periodic(Periodic&&) = default;
  Periodic& operator=(Periodic&& other) noexcept;
  Periodic(const Periodic&) = delete;
  Periodic& operator=(const Periodic&) = delete;
  ~Periodic() { stop(); }

  /// No more calls; waits for one that runs, unless it is the one that calls this.
  void stop();

 private:
  class Ticker;
  struct Job;

  std::shared_ptr<Ticker> ticker_;
  std::shared_ptr<Job> job_;
};

}  // namespace external_command
