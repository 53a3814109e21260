// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>

#include "external_command/core/cancel_token.h"

namespace external_command {

using Clock = std::chrono::steady_clock;

inline double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

inline Clock::time_point after(Clock::time_point begin, double seconds) {
  return begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// When a stage has to end: at a deadline, or once the command is cancelled.
class StopCondition {
 public:
  StopCondition(const CancelToken& cancel, Clock::time_point deadline) : cancel_(cancel), deadline_(deadline) {}

  bool isReached() const { return cancel_.isCancelled() || Clock::now() >= deadline_; }

  /// The same, but not later than `seconds` from now.
  StopCondition within(double seconds) const { return {cancel_, std::min(after(Clock::now(), seconds), deadline_)}; }

  /// The same, but `seconds` sooner.
  StopCondition sooner(double seconds) const { return {cancel_, after(deadline_, -seconds)}; }

  const CancelToken& cancel() const { return cancel_; }

 private:
  CancelToken cancel_;
  Clock::time_point deadline_;
};

/// An amount of work, the same on every machine, with a clock as its guard.
class WorkBudget {
 public:
  WorkBudget(std::size_t steps, const StopCondition& stop) : left_(steps), stop_(stop) {}

  /// Takes one step; false once the work is used up, or the clock says stop.
  bool spend() {
    if (left_ == 0) return false;
    --left_;
    // the clock is not asked every time: it costs as much as a small step
    if (left_ % 16 == 0 && stop_.isReached()) left_ = 0;
    return left_ > 0;
  }

  bool isUsedUp() const { return left_ == 0; }
  const StopCondition& stop() const { return stop_; }

 private:
  std::size_t left_;
  StopCondition stop_;
};

}  // namespace external_command
