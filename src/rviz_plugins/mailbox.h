// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMetaObject>
#include <QObject>
#include <functional>
#include <mutex>
#include <utility>

namespace external_command {

/// Hands jobs to the thread of a QObject, from any thread, until close(). Thread-safe.
class Mailbox {
 public:
  explicit Mailbox(QObject* receiver) : receiver_(receiver) {}

  /// Runs `job` in the receiver's thread, soon; drops it after close().
  void post(std::function<void()> job) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (receiver_) QMetaObject::invokeMethod(receiver_, std::move(job), Qt::QueuedConnection);
  }

  /// To be called before the receiver goes.
  void close() {
    const std::lock_guard<std::mutex> lock(mutex_);
    receiver_ = nullptr;
  }

 private:
  std::mutex mutex_;
  QObject* receiver_;
};

}  // namespace external_command
