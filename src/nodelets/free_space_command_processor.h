// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "distance_limits.h"
#include "external_command/FreeSpace.h"
#include "nodelets/manoeuvres/manoeuvre_planner.h"

namespace external_command {

/// Drives from the vehicle's pose to a pose inside polygons of the command, without lanes or a map.
class FreeSpaceCommandProcessor : public MotionCommandProcessor<FreeSpace> {
 public:
  FreeSpaceCommandProcessor();
  ~FreeSpaceCommandProcessor() override;

 private:
  void start() override;
  void check(const FreeSpaceCommand& command) const override;
  double planningTime(const FreeSpaceCommand& command, const Pose2d& vehicle) const override;
  std::optional<RoutingTask> convert(const FreeSpaceCommand& command, const PlanStart& start) override;
  bool takesOver() const override { return true; }
  void processSpecialCommand(const FreeSpaceCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  Pose2d goalOf(const FreeSpaceCommand& command, const PlanStart& start, std::vector<std::string>* warnings) const;

  std::optional<ManoeuvrePlanner> planner_;
  DistanceLimits goal_limits_{100.0, 0.0};
};

}  // namespace external_command
