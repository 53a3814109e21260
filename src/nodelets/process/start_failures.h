// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace external_command {

/// Slows down whoever starts a process again and again that ends each time for the same reason: the first time it ends
/// at once, then it waits before it ends, twice as long each time. The count goes from process to process on the
/// parameter server, and is forgotten where the last end is older than a respawn takes: a person started it.
class StartFailures {
 public:
  /// Takes over what the process before left, and deletes it there.
  /// @param node  whose namespace it is left in.
  explicit StartFailures(const std::string& node);

  /// Leaves word for the process after. @return how long to wait before the end [s].
  double note(const std::string& reason);

 private:
  const std::string key_;
  std::string reason_;
  int count_ = 0;
};

/// 0 for the first failure, then 2, 4, 8 ... up to 60 [s].
double pauseAfter(int failures);

}  // namespace external_command
