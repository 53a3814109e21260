// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "external_command/core/error.h"

namespace external_command {

/// How often commands were refused since the start, and why. Thread-safe.
class RefusalCounts {
 public:
  static constexpr std::size_t kCodes = 16;  ///< of ErrorCode

  void add(std::uint16_t code) {
    ++counts_[code < kCodes ? code : static_cast<std::size_t>(ErrorCode::kInternalError)];
  }
  std::uint64_t of(ErrorCode code) const { return counts_[static_cast<std::size_t>(code)]; }

 private:
  std::array<std::atomic<std::uint64_t>, kCodes> counts_{};
};

}  // namespace external_command
