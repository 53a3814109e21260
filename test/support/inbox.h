// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "external_command/ros/executor.h"

namespace external_command {

/// The messages of one topic, received on a thread of its own.
template <class Message>
class Inbox {
 public:
  explicit Inbox(const std::string& topic) {
    ros::NodeHandle nh;
    nh.setCallbackQueue(executor_.queue());
    const boost::function<void(const Message&)> on_message = [this](const Message& message) {
      const std::lock_guard<std::mutex> lock(mutex_);
      messages_.push_back(message);
      changed_.notify_all();
    };
    subscriber_ = nh.subscribe<Message>(topic, 100, on_message);
  }
  ~Inbox() { executor_.stop(); }

  /// False where `count` messages that match have not come within 10 s.
  bool waitFor(std::size_t count, bool (*matches)(const Message&) = &isAny) {
    const auto found = [&] { return std::count_if(messages_.begin(), messages_.end(), matches); };
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(10), [&] { return found() >= static_cast<long>(count); });
  }

  std::vector<Message> messages() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }

 private:
  static bool isAny(const Message& /*message*/) { return true; }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Message> messages_;
  Executor executor_;
  ros::Subscriber subscriber_;
};

}  // namespace external_command
