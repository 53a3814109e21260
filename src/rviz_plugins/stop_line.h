// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/service_client.h>

#include <mutex>
#include <string>

#include "external_command/Action.h"

namespace external_command {

/// A connection to the gateway's actions that is kept: a STOP needs no ROS master then, and no time to connect.
/// Thread-safe; call() waits for no other call().
class StopLine {
 public:
  /// @param service  its resolved name.
  explicit StopLine(std::string service) : service_(std::move(service)) {}

  /// Connects, unless it is connected. Waits for master and server.
  /// @return whether it is connected.
  bool keep();

  /// By the connection that is kept where it is free, else, or where that fails, by one of its own.
  bool call(Action* action);

  const std::string& service() const { return service_; }

 private:
  const std::string service_;
  std::mutex mutex_;
  ros::ServiceClient kept_;
  bool is_busy_ = false;  ///< a call goes by the one that is kept
};

}  // namespace external_command
