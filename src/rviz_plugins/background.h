// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>

#include "mailbox.h"

namespace external_command {

/// Work that may take for ever (calls of services, talks with the ROS master), on threads of its own: none waits for
/// another, and the thread of the receiver waits for none.
class Background {
 public:
  using Job = std::function<void()>;

  /// @param receiver  in whose thread the work is followed up; must live as long as this.
  explicit Background(QObject* receiver) : mailbox_(std::make_shared<Mailbox>(receiver)) {}

  /// What is still at work goes on, and is followed up by nothing.
  ~Background() { mailbox_->close(); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Runs `work` on a thread of its own; what it returns runs in the thread of the receiver.
  /// @return false: the system has no thread to give; nothing is run.
  bool run(std::function<Job()> work);

  /// Waits for what is at work, no longer than `limit`.
  void waitForEnd(std::chrono::milliseconds limit) const;

  /// How many are at work.
  int count() const { return *count_; }

 private:
  const std::shared_ptr<Mailbox> mailbox_;
  const std::shared_ptr<std::atomic<int>> count_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace external_command
