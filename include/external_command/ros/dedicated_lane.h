// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace external_command {

/// A callback queue with threads of its own, so that nothing else in the process can delay what runs on it.
/// Two rules for the class whose callbacks it runs: it stops the lane before what they use goes (last member, or stop()
/// in the destructor); and what is bound to queue() - timer, subscriber, server - goes before the lane, since roscpp
/// takes it out of the queue then.
class DedicatedLane {
 public:
  explicit DedicatedLane(unsigned threads = 1);
  ~DedicatedLane();
  DedicatedLane(const DedicatedLane&) = delete;
  DedicatedLane& operator=(const DedicatedLane&) = delete;

  /// For the `callback_queue` of advertise, subscribe and timer options.
  ros::CallbackQueueInterface* queue() { return queue_.get(); }

  /// Runs `job` on the lane. After stop() it is dropped.
  void post(std::function<void()> job);

  /// Waits for running callbacks and drops the waiting ones. Idempotent. Not from a callback of the lane itself.
  void stop();

 private:
  std::unique_ptr<ros::CallbackQueue> queue_;
  std::atomic<bool> is_running_{true};
  std::vector<std::thread> threads_;
};

}  // namespace external_command
