// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "external_command/ValetParking.h"
#include "external_command/ros/motion_command_processor.h"

namespace external_command {

/// Drives along the lanes to a parking space of the map.
class ValetParkingCommandProcessor : public MotionCommandProcessor<ValetParking> {
 public:
  ValetParkingCommandProcessor();
  ~ValetParkingCommandProcessor() override;

 private:
  void check(const ValetParkingCommand& command) const override;
  std::optional<RoutingTask> convert(const ValetParkingCommand& command) override;
  void processSpecialCommand(const ValetParkingCommand& command, const CancelToken& cancel, MotionPlan* plan) override;
};

}  // namespace external_command
