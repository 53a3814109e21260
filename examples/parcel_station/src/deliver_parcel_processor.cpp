// SPDX-License-Identifier: Apache-2.0
#include "deliver_parcel_processor.h"

#include <external_command/ros/action_front.h>
#include <external_command/ros/any_message.h>

#include "parcel_station/DeliverParcelAction.h"

namespace parcel_station {

namespace ec = external_command;

DeliverParcelProcessor::DeliverParcelProcessor() : MotionCommandProcessor("parcel_station/deliver_parcel") {
  offerAction<DeliverParcelAction>();
}

DeliverParcelProcessor::~DeliverParcelProcessor() { stopServing(); }

void DeliverParcelProcessor::check(const DeliverParcelCommand& command) const {
  if (command.parcel_id.empty()) throw ec::InvalidRequest("parcel_id is empty; say which parcel to deliver");
  ec::requireSendable(command.station, "station");
  ec::requireTargetSpeed(command.target_speed);
}

std::optional<ec::RoutingTask> DeliverParcelProcessor::convert(const DeliverParcelCommand& command,
                                                               const ec::PlanStart& start) {
  const std::string& frame = command.header.frame_id;
  ec::RoutingTask task = ec::beginRoutingTask(context(), start, frame, false, {});
  ec::setGoal(context(), frame, command.station, "station", &task);
  return task;
}

void DeliverParcelProcessor::processSpecialCommand(const DeliverParcelCommand& command,
                                                   const ec::CancelToken& /*cancel*/, ec::MotionPlan* plan) {
  plan->command.command_type = ec::PlanningCommand::CUSTOM;
  plan->command.custom_command = ec::packAny(command);
}

}  // namespace parcel_station
