// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/publisher.h>
#include <ros/time.h>

#include "external_command/Readiness.h"
#include "external_command/ros/conditions.h"

namespace external_command {

/// Publishes how the conditions stand when that changes. A number that counts on in a message (the age of a pose) is
/// no change by itself, and brought up to date now and then. Not thread-safe.
class ReadinessTopic {
 public:
  /// @param publisher  latched. @param conditions  must live as long as this.
  ReadinessTopic(ros::Publisher publisher, const Conditions& conditions)
      : publisher_(std::move(publisher)), conditions_(conditions) {}

  /// To be called some times per second.
  void update();

 private:
  const ros::Publisher publisher_;
  const Conditions& conditions_;
  bool is_published_ = false;
  Readiness last_;
  ros::SteadyTime published_at_;
};

Readiness toMsg(const std::vector<Condition>& conditions);

/// True where both say the same, whatever numbers stand in their messages.
bool sayTheSame(const Readiness& a, const Readiness& b);

}  // namespace external_command
