// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace external_command {

/// The name of a frame as tf2 knows it: programs of the days of tf 1 begin it with a slash.
inline std::string frameId(const std::string& frame) {
  const std::size_t first = frame.find_first_not_of('/');
  return first == std::string::npos ? "" : frame.substr(first);
}

}  // namespace external_command
