// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "external_command/ValetParking.h"
#include "parking_manoeuvres.h"

namespace external_command {

/// Drives along the lanes to a parking space of the map and parks in it.
class ValetParkingCommandProcessor : public MotionCommandProcessor<ValetParking> {
 public:
  ValetParkingCommandProcessor();
  ~ValetParkingCommandProcessor() override;

 private:
  void start() override;
  void check(const ValetParkingCommand& command) const override;
  std::optional<RoutingTask> convert(const ValetParkingCommand& command, const PlanStart& start) override;
  void processSpecialCommand(const ValetParkingCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  std::optional<ManoeuvrePlanner> planner_;
  ParkingDirection direction_ = ParkingDirection::kCheaper;
};

}  // namespace external_command
