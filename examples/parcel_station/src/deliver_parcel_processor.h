// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <external_command/ros/motion_command_processor.h>

#include <optional>

#include "parcel_station/DeliverParcel.h"

namespace parcel_station {

/// Drives along the lanes to a station. The planning module gets the whole command, and hands the parcel over there.
class DeliverParcelProcessor : public external_command::MotionCommandProcessor<DeliverParcel> {
 public:
  DeliverParcelProcessor();
  ~DeliverParcelProcessor() override;

 private:
  void check(const DeliverParcelCommand& command) const override;
  std::optional<external_command::RoutingTask> convert(const DeliverParcelCommand& command,
                                                       const external_command::PlanStart& start) override;
  void processSpecialCommand(const DeliverParcelCommand& command, const external_command::CancelToken& cancel,
                             external_command::MotionPlan* plan) override;
};

}  // namespace parcel_station
