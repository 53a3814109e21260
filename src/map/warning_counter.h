// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/text.h"
#include "external_command/map/map_data.h"

namespace external_command {

/// Counts one kind of fault and keeps the first as the example.
class WarningCounter {
 public:
  /// @param what  follows the number: "references to lanes that do not exist".
  explicit WarningCounter(const char* what) : what_(what) {}

  template <class... Args>
  void add(const Args&... example) {
    if (count_++ == 0) example_ = text(example...);
  }

  /// Appends the warning where anything was counted.
  void report(std::vector<MapWarning>* warnings) const {
    if (count_ > 0) warnings->push_back({text(count_, " ", what_, ", e.g. ", example_), count_});
  }

 private:
  const char* what_;
  std::size_t count_ = 0;
  std::string example_;
};

}  // namespace external_command
