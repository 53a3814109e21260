// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "external_command/CommandStatus.h"
#include "external_command/PlannedPath.h"
#include "external_command/core/pose.h"

namespace external_command {

/// A motion service of this process that drives to one pose.
class GoalPoseService {
 public:
  /// Poses are in the map frame.
  struct Goal {
    std::int64_t command_id = 0;
    bool dry_run = false;
    Pose2d pose;
    bool has_heading = true;      ///< false: any will do, where the service can do without
    std::optional<Pose2d> start;  ///< nullopt: where the vehicle is
  };

  struct Answer {
    CommandStatus status;
    std::vector<std::string> warnings;
    PlannedPath path;  ///< of a dry run
  };

  /// @param kind  lane_follow, free_space or precise_parking. @param name  of the service.
  /// @throws InvalidParameter  another kind.
  static std::unique_ptr<GoalPoseService> make(const std::string& kind, const std::string& name);

  virtual ~GoalPoseService() = default;

  /// Calls the service and waits for its answer.
  /// @param header  of the connection.
  /// @throws NotReady  the service is not one of this process. @throws InvalidRequest  it takes no start.
  Answer call(ros::NodeHandle& nh, const Goal& goal, const ros::M_string& header) const;

 protected:
  explicit GoalPoseService(std::string name) : name_(std::move(name)) {}

 private:
  virtual Answer callService(ros::NodeHandle& nh, const std::string& name, const Goal& goal,
                             const ros::M_string& header) const = 0;

  const std::string name_;
};

}  // namespace external_command
