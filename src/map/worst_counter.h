// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/text.h"
#include "external_command/map/map_data.h"

namespace external_command {

/// Counts one kind of fault that has a size, and keeps the largest as the example.
class WorstCounter {
 public:
  /// @param what  follows the number: "links whose ends do not meet".
  explicit WorstCounter(const char* what) : what_(what) {}

  template <class... Args>
  void add(double size, const Args&... example) {
    if (count_++ > 0 && size <= worst_) return;
    worst_ = size;
    example_ = text(example...);
  }

  /// Appends the warning where anything was counted.
  void report(std::vector<MapWarning>* warnings) const {
    if (count_ > 0) warnings->push_back({text(count_, " ", what_, ", the worst: ", example_), count_});
  }

 private:
  const char* what_;
  std::size_t count_ = 0;
  double worst_ = 0.0;
  std::string example_;
};

}  // namespace external_command
