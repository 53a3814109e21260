// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace external_command {

/// The moment by which a piece of work is to be done, by a clock that never jumps.
class Deadline {
 public:
  /// @param time  from now [s].
  explicit Deadline(double time) : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(time))) {}

  /// What is left [s], never negative.
  double left() const { return std::max(0.0, Seconds(end_ - Clock::now()).count()); }

  bool hasPassed() const { return left() <= 0.0; }

  /// The sooner of both.
  Deadline orSooner(const Deadline& other) const { return other.end_ < end_ ? other : *this; }

  /// The end of a share of what is left, in [0, 1].
  Deadline part(double share) const { return Deadline(share * left()); }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  Clock::time_point end_;
};

}  // namespace external_command
