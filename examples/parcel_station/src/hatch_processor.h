// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <external_command/ros/service_command_processor.h>
#include <ros/publisher.h>

#include "parcel_station/Hatch.h"

namespace parcel_station {

/// Opens and closes the hatches of the vehicle's compartments: checks the command and passes it on.
class HatchProcessor : public external_command::ServiceCommandProcessor<Hatch> {
 public:
  HatchProcessor();
  ~HatchProcessor() override;

 private:
  void start() override;
  void check(const HatchCommand& command) const override;
  external_command::CommandStatus execute(const HatchCommand& command,
                                          const external_command::AdmittedCommand& admitted,
                                          HatchResponse* response) override;

  int compartments_ = 8;
  ros::Publisher publisher_;
};

}  // namespace parcel_station
