// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "external_command/PreciseParking.h"
#include "nodelets/manoeuvres/parking_manoeuvres.h"

namespace external_command {

/// Drives along the lanes to an area of the map and parks there at an exact pose.
class PreciseParkingCommandProcessor : public MotionCommandProcessor<PreciseParking> {
 public:
  PreciseParkingCommandProcessor();
  ~PreciseParkingCommandProcessor() override;

 private:
  void start() override;
  void check(const PreciseParkingCommand& command) const override;
  std::optional<RoutingTask> convert(const PreciseParkingCommand& command, const PlanStart& start) override;
  double planningTime(const PreciseParkingCommand& command, const Pose2d& vehicle) const override;
  bool takesOver() const override { return true; }
  void processSpecialCommand(const PreciseParkingCommand& command, const CancelToken& cancel,
                             MotionPlan* plan) override;

  Pose2d spotOf(const PreciseParkingCommand& command) const;
  bool needsNoLanes(const PreciseParkingCommand& command, const PlanStart& start) const;
  const Area& areaOf(const PreciseParkingCommand& command) const;

  std::optional<ManoeuvrePlanner> planner_;
  double straight_last_ = 2.0;     ///< last stretch into the spot, straight [m]
  double access_distance_ = 10.0;  ///< of lanes to areas without overlaps, at most [m]
};

}  // namespace external_command
