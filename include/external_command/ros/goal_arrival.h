// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <exception>
#include <string>

#include "external_command/ros/command_identity.h"

namespace external_command {

/// How the goal of an action came in.
struct GoalArrival {
  std::string caller;  ///< node name; empty where it is not known
  ArrivalNumber arrival = 0;
  std::exception_ptr fault;  ///< why nothing was built from its bytes; its content is empty then
};

/// Topics hold back nobody who sends: whoever takes messages from one pauses where they come too often. 20 at once and
/// 100 a second are taken without delay. Of one thread.
class ArrivalPace {
 public:
  void pauseIfFlooded();

 private:
  std::chrono::steady_clock::time_point next_;
};

}  // namespace external_command
