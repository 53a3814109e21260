// SPDX-License-Identifier: Apache-2.0
#include "hatch_processor.h"

#include <external_command/ros/checks.h>

namespace parcel_station {

namespace ec = external_command;

HatchProcessor::HatchProcessor() : ServiceCommandProcessor("parcel_station/hatch") {}

HatchProcessor::~HatchProcessor() { stopServing(); }

void HatchProcessor::start() {
  ServiceCommandProcessor::start();
  parameters().readWithin("compartments", 1, 255, &compartments_);
  publisher_ = context().advertise<HatchCommand>("parcel_station/hatch_command", false);
}

void HatchProcessor::check(const HatchCommand& command) const {
  ec::requireWithin(command.compartment, 1, compartments_, "compartment");
}

ec::CommandStatus HatchProcessor::execute(const HatchCommand& command, const ec::AdmittedCommand& /*admitted*/,
                                          HatchResponse* /*response*/) {
  publisher_.publish(command);
  return ec::makeStatus(command.command_id, ec::CommandStatus::FINISHED, ec::ErrorCode::kOk,
                        command.open ? "open" : "closed");
}

}  // namespace parcel_station
