// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue.h>

#include <functional>
#include <memory>
#include <string>

#include "external_command/ros/guarded_queue.h"
#include "external_command/ros/periodic.h"

namespace external_command {

/// How the threads of an executor stand to those of the rest of the process.
enum class ExecutorPriority {
  kUrgent,  ///< real-time where the process may ask for that (CAP_SYS_NICE, or an rtprio limit), else normal
  kNormal,
  kBackground,  ///< below normal: planning
};

struct ExecutorOptions {
  std::string name = "an executor";  ///< in log lines
  unsigned threads = 1;              ///< at most; made when they are needed
  ExecutorPriority priority = ExecutorPriority::kNormal;
  GuardedQueue::Stamp stamp = {};  ///< taken of each callback when it is added
};

/// A callback queue with threads of its own, so that nothing else in the process can delay what runs on it. What its
/// callbacks throw is caught, logged and counted (GuardedQueue).
/// Two rules for the class whose callbacks it runs: it stops the executor before what they use goes (last member, or
/// stop() in the destructor); and what is bound to queue() - timer, subscriber, server - goes before the executor,
/// since roscpp takes it out of the queue then.
class Executor {
 public:
  explicit Executor(ExecutorOptions options = {});
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// For the `callback_queue` of advertise, subscribe and timer options.
  ros::CallbackQueueInterface* queue();

  /// Runs `job` on the executor. After stop() it is dropped.
  void post(std::function<void()> job);

  /// Runs `job` every `period` [s], where it is `wanted` (see Periodic), for as long as what it returns lives, which
  /// must not be longer than the executor.
  [[nodiscard]] Periodic every(double period, std::function<void()> job, Periodic::Wanted wanted = {});

  /// Waits for running callbacks and drops the waiting ones. Idempotent. Not from a callback of the executor itself.
  void stop();

 private:
  struct Queues;

  const std::shared_ptr<Queues> queues_;
};

}  // namespace external_command
