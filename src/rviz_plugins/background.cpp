// SPDX-License-Identifier: Apache-2.0
#include "background.h"

#include <ros/console.h>

#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace external_command {

bool Background::run(std::function<Job()> work) {
  ++*count_;
  try {
    // Detached: a call to a server that hangs cannot be ended. The library is never unloaded (-z nodelete).
    std::thread([work = std::move(work), mailbox = mailbox_, count = count_]() mutable {
      try {
        mailbox->post(work());
      } catch (const std::exception& error) {
        ROS_ERROR_STREAM("the panel: " << error.what());
      }
      work = nullptr;  // what it holds goes before it counts as done
      --*count;
    }).detach();
  } catch (const std::system_error&) {
    --*count_;
    return false;
  }
  return true;
}

void Background::waitForEnd(std::chrono::milliseconds limit) const {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (count() > 0 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace external_command
