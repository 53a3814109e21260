// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

namespace external_command {

/// Requests for plans: one at a time is in work, a few wait in the order of their coming. Thread-safe.
class PlanLine {
 public:
  explicit PlanLine(unsigned most_waiting) : most_waiting_(most_waiting) {}

  /// Waits for its turn, and calls `plan`.
  /// @throws NotReady   as many as may wait do already; at once.
  /// @throws Cancelled  end() was called before its turn came.
  void run(const std::function<void()>& plan);

  /// @throws Cancelled  end() was called.
  void throwIfEnded() const;

  std::uint64_t waiting() const;

  /// Lets none in from now on, and returns when the one in work has left.
  /// @param cancel  ends what that one waits for; called again and again, since it may be about to begin.
  void end(const std::function<void()>& cancel);

 private:
  void throwIfEndedLocked() const;

  const unsigned most_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool is_ended_ = false, is_in_work_ = false;
  std::uint64_t tickets_ = 0, turn_ = 0;  ///< given; the next that is let in
};

}  // namespace external_command
