// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace external_command {

/// Slows down callers that ask again at once when they are told that a command is busy, cancelled or superseded: they
/// would take the processor from a STOP, and from the planning that they wait for. The first such answers, and 100 a
/// second, leave at once; the others after a short pause. Thread-safe.
class RefusalPace {
 public:
  /// @param most_pausing  answers that may pause at once, each in its thread; what is beyond them leaves at once.
  explicit RefusalPace(unsigned most_pausing) : most_pausing_(most_pausing) {}

  /// Called before such an answer leaves.
  void pauseIfFlooded();

 private:
  const unsigned most_pausing_;
  std::atomic<unsigned> pausing_{0};
};

}  // namespace external_command
