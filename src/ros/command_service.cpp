// SPDX-License-Identifier: Apache-2.0
#include <ros/console.h>

#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/service_command_processor.h"

namespace external_command {

CommandService::CommandService(std::string service, unsigned threads)
    : service_name_(std::move(service)), threads_(threads) {}

CommandService::~CommandService() {
  if (lane_) ROS_ERROR_STREAM(id() << ": its destructor did not call stopServing(); a late request would crash");
  stopServing();
}

void CommandService::stopServing() {
  server_.shutdown();
  plans_in_work_.cancelForGood();
  dry_runs_in_work_.cancelForGood();
  lane_.reset();  // joins
}

void CommandService::start() {
  parameters().readName("input_command_name", &service_name_);
  log_publisher_ = context().advertise<CommandLogEntry>(context().params().log_topic, false);
  ros::NodeHandle nh(getNodeHandle());
  nh.setCallbackQueue(context().housekeeping().queue());
  // The callback outlives this object by no more than the context, which owns all that it uses.
  const boost::function<void(const CommandStatus&)> report =
      [&registry = context().registry(), name = id()](const CommandStatus& status) { registry.report(status, name); };
  for (const std::string& topic : topicNames("input_command_status_name", "planning/command_status")) {
    report_subscribers_.push_back(nh.subscribe<CommandStatus>(topic, 100, report));
  }
}

void CommandService::open() {
  lane_ = std::make_unique<DedicatedLane>(threads_);
  ros::AdvertiseServiceOptions options = serviceOptions();
  options.callback_queue = lane_->queue();
  server_ = getNodeHandle().advertiseService(options);
  if (server_) return;
  stopServing();
  throw InternalError(text("service ", getNodeHandle().resolveName(service_name_),
                           " is advertised by this process already; is the same processor loaded twice?"));
}

CommandStatus CommandService::admitAndExecute(std::int64_t wanted_id, std::uint64_t digest,
                                              const std::function<CommandStatus(std::int64_t)>& execute) {
  const CommandRegistry::Admission admission = context().registry().admit(wanted_id, id(), digest);
  if (admission.running) return *admission.running;
  CommandStatus status;
  try {
    status = execute(admission.command_id);
  } catch (...) {
    status = statusFrom(std::current_exception(), admission.command_id);
  }
  tell(status);
  if (hasEnded(status)) context().registry().update(status);
  return status;
}

CommandStatus CommandService::refuse(std::int64_t wanted_id) {
  const CommandStatus status = context().registry().refuse(statusFrom(std::current_exception(), wanted_id), id());
  tell(status);
  return status;
}

void CommandService::tell(const CommandStatus& status) const {
  // A terminal or a disk that stalls must not delay an answer, or a STOP.
  context().housekeeping().post([service = service_name_, status] {
    if (status.status == CommandStatus::ERROR) {
      ROS_WARN_STREAM(service << " " << status.command_id << " refused: " << status.message);
    } else {
      ROS_INFO_STREAM(service << " " << status.command_id << ": " << status.message);
    }
  });
}

void CommandService::log(CommandLogEntry entry) const {
  entry.service = server_.getService();
  log_publisher_.publish(entry);
}

}  // namespace external_command
