// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "external_command/core/error.h"

namespace external_command {

/// Called every few milliseconds of a long piece of work; what it throws ends that.
using Checkpoint = std::function<void()>;

/// Read side of a cancellation: a cheap value that every long loop polls. A default constructed token is never raised.
/// Thread-safe.
class CancelToken {
 public:
  CancelToken() = default;

  bool isCancelled() const { return raised_ && raised_->load(std::memory_order_relaxed); }

  /// @throws Cancelled  the token was raised.
  void throwIfCancelled() const {
    if (isCancelled()) throw Cancelled("planning was cancelled");
  }

  /// Throws Cancelled once the token was raised.
  Checkpoint checkpoint() const {
    return [token = *this] { token.throwIfCancelled(); };
  }

 private:
  friend class CancelSource;
  explicit CancelToken(std::shared_ptr<const std::atomic<bool>> raised) : raised_(std::move(raised)) {}

  std::shared_ptr<const std::atomic<bool>> raised_;
};

/// Write side: raises every token it has handed out, once and for good. Thread-safe; copies share one state.
class CancelSource {
 public:
  CancelToken token() const { return CancelToken(raised_); }
  void cancel() const { raised_->store(true, std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> raised_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace external_command
