// SPDX-License-Identifier: Apache-2.0
#include "command_services.h"

#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/status.h"
#include "serve.h"

namespace external_command {

namespace {

/// The response, whose status tells why, to a request that nothing can be built from.
template <class Response>
Response refusal() {
  Response response;
  response.status = statusFrom(std::current_exception(), 0);
  return response;
}

}  // namespace

CommandServices::CommandServices(const ros::NodeHandle& nh, const ParameterReader& parameters,
                                 std::shared_ptr<ProcessContext> context)
    : nh_(nh), parameters_(parameters), context_(std::move(context)) {
  serve<GetCommandStatus>(
      "command_status_service_name", "external_command/command_status", &status_executor_,
      {[this](const auto& request, const MessageSize&, const ros::M_string&) { return status(request); },
       [](const ros::SerializedMessage&, const ros::M_string&) { return refusal<GetCommandStatus::Response>(); }});
  serve<GetCurrentCommand>("current_command_service_name", "external_command/current_command", &status_executor_,
                           {[this](const auto&, const MessageSize&, const ros::M_string&) { return current(); },
                            [](const ros::SerializedMessage&, const ros::M_string&) {
                              GetCurrentCommand::Response response;
                              response.motion = statusFrom(std::current_exception(), 0);
                              return response;
                            }});
  serve<CancelCommand>(
      "cancel_command_service_name", "external_command/cancel_command", &cancel_executor_,
      {[this](const auto& request, const MessageSize&, const ros::M_string& header) { return cancel(request, header); },
       [](const ros::SerializedMessage&, const ros::M_string&) { return refusal<CancelCommand::Response>(); }});
}

CommandServices::~CommandServices() {
  for (ros::ServiceServer& server : servers_) server.shutdown();
}

template <class Service>
void CommandServices::serve(const std::string& key, std::string name, Executor* executor,
                            BoundedServiceCallbacks<Service> callbacks) {
  parameters_.readName(key, &name);
  servers_.push_back(serveOn<Service>(executor, nh_, name, std::move(callbacks), context_->params().requests));
}

GetCommandStatus::Response CommandServices::status(const GetCommandStatus::Request& request) const {
  GetCommandStatus::Response response;
  response.status = context_->registry().find(request.command_id);
  return response;
}

GetCurrentCommand::Response CommandServices::current() const {
  GetCurrentCommand::Response response;
  const std::optional<CommandStatus> motion = context_->registry().statusOf(context_->gate().lastMotion());
  response.motion = motion ? *motion
                           : makeStatus(0, CommandStatus::UNKNOWN, ErrorCode::kUnknownId,
                                        "no motion command was sent yet, or it is long forgotten");
  response.running = context_->registry().running();
  return response;
}

CancelCommand::Response CommandServices::cancel(const CancelCommand::Request& request, const ros::M_string& header) {
  const auto caller = header.find("callerid");
  const std::string by = text("cancel_command", caller == header.end() ? "" : " of " + caller->second);
  const Cancellation cancellation = context_->cancelById(request.command_id, by);
  CancelCommand::Response response;
  response.was_running = cancellation.was_running;
  response.status = cancellation.status;
  if (response.was_running) {
    logLater(LogLevel::kInfo, text("command ", request.command_id, ": ", response.status.message));
  }
  return response;
}

}  // namespace external_command
