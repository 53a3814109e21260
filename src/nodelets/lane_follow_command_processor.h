// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "external_command/LaneFollow.h"
#include "nodelets/manoeuvres/manoeuvre_planner.h"

namespace external_command {

/// Drives along the lanes to a pose.
class LaneFollowCommandProcessor : public MotionCommandProcessor<LaneFollow> {
 public:
  LaneFollowCommandProcessor();
  ~LaneFollowCommandProcessor() override;

 private:
  void start() override;
  void check(const LaneFollowCommand& command) const override;
  std::optional<RoutingTask> convert(const LaneFollowCommand& command, const PlanStart& start) override;
  bool isPlannedAtOnce(const LaneFollowCommand& command) const override;
  void processSpecialCommand(const LaneFollowCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  std::optional<ManoeuvrePlanner> planner_;
};

}  // namespace external_command
