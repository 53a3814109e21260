// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue.h>

#include <functional>
#include <memory>
#include <string>

#include "external_command/ros/guarded_queue.h"

namespace external_command {

/// How the threads of a lane stand to those of the rest of the process.
enum class LanePriority {
  kUrgent,  ///< real-time where the process may ask for that (CAP_SYS_NICE, or an rtprio limit), else normal
  kNormal,
  kBackground,  ///< below normal: planning
};

struct LaneOptions {
  std::string name = "a lane";  ///< in log lines
  unsigned threads = 1;         ///< at most; made when they are needed
  LanePriority priority = LanePriority::kNormal;
  GuardedQueue::Stamp stamp = {};  ///< taken of each callback when it is added
};

/// A callback queue with threads of its own, so that nothing else in the process can delay what runs on it. What its
/// callbacks throw is caught, logged and counted (GuardedQueue).
/// Two rules for the class whose callbacks it runs: it stops the lane before what they use goes (last member, or stop()
/// in the destructor); and what is bound to queue() - timer, subscriber, server - goes before the lane, since roscpp
/// takes it out of the queue then.
class DedicatedLane {
 public:
  explicit DedicatedLane(LaneOptions options = {});
  ~DedicatedLane();
  DedicatedLane(const DedicatedLane&) = delete;
  DedicatedLane& operator=(const DedicatedLane&) = delete;

  /// For the `callback_queue` of advertise, subscribe and timer options.
  ros::CallbackQueueInterface* queue();

  /// Runs `job` on the lane. After stop() it is dropped.
  void post(std::function<void()> job);

  /// Waits for running callbacks and drops the waiting ones. Idempotent. Not from a callback of the lane itself.
  void stop();

 private:
  struct Queues;

  const std::shared_ptr<Queues> queues_;
};

}  // namespace external_command
