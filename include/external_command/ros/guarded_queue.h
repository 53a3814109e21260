// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue_interface.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace external_command {

/// Passes callbacks on to another queue, and catches what they throw: an exception of a timer or a subscriber would
/// end the process. It is logged with the queue's name, at most once in 10 s, and counted.
class GuardedQueue : public ros::CallbackQueueInterface {
 public:
  /// Called in the thread that adds a callback, at that moment.
  using Stamp = std::function<std::uint64_t()>;

  /// @param queue  must live as long as this one.
  GuardedQueue(std::string name, ros::CallbackQueueInterface* queue, Stamp stamp = {});

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner_id) override;
  void removeByID(std::uint64_t owner_id) override;

  /// What the stamp was when the callback that runs in this thread was added; 0 where none runs, or it has no stamp.
  static std::uint64_t stampOfRunningCallback();

 private:
  const std::string name_;
  ros::CallbackQueueInterface* const queue_;
  const Stamp stamp_;
};

/// Exceptions caught since the start, in all queues of the process.
std::uint64_t caughtExceptions();

/// Keeps something that a queue belongs to for some time before it is destroyed: roscpp's network thread hands requests
/// over by a plain pointer to the queue, and may still be about to do so when the service is gone.
void retire(std::shared_ptr<void> queue);

}  // namespace external_command
