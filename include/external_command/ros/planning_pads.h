// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/publisher.h>

#include <cstdint>
#include <mutex>
#include <vector>

namespace external_command {

/// Where actions for the planner go: `output_command_name` of the action processor, whether or not that is loaded,
/// since a cancelled motion is cleared there too. Thread-safe.
class PlanningPads {
 public:
  explicit PlanningPads(std::vector<ros::Publisher> publishers) : publishers_(std::move(publishers)) {}

  /// From now on pads go to `publishers` instead.
  void use(std::vector<ros::Publisher> publishers);

  /// @param action  a constant of PlanningPad.
  /// @param stamp   tells the planner which motions a stop is about: those of an earlier one.
  void send(std::uint8_t action, const ros::Time& stamp) const;

 private:
  mutable std::mutex mutex_;
  std::vector<ros::Publisher> publishers_;
};

}  // namespace external_command
