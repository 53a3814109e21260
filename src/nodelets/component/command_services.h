// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/service_server.h>

#include <memory>
#include <string>
#include <vector>

#include "external_command/CancelCommand.h"
#include "external_command/GetCommandStatus.h"
#include "external_command/GetCurrentCommand.h"
#include "external_command/ros/bounded_service.h"
#include "external_command/ros/process_context.h"

namespace external_command {

/// The services about commands of all processors: their statuses, what runs, and to cancel one. None waits for what is
/// planned.
class CommandServices {
 public:
  /// @throws InvalidParameter  @throws InternalError  this process has one of the services already.
  CommandServices(const ros::NodeHandle& nh, const ParameterReader& parameters,
                  std::shared_ptr<ProcessContext> context);
  ~CommandServices();

 private:
  /// @param name  default of the parameter `key`.
  template <class Service>
  void serve(const std::string& key, std::string name, Executor* executor, BoundedServiceCallbacks<Service> callbacks);

  GetCommandStatus::Response status(const GetCommandStatus::Request& request) const;
  GetCurrentCommand::Response current() const;
  CancelCommand::Response cancel(const CancelCommand::Request& request, const ros::M_string& header);

  ros::NodeHandle nh_;
  const ParameterReader parameters_;
  const std::shared_ptr<ProcessContext> context_;
  std::vector<ros::ServiceServer> servers_;
  Executor status_executor_{ExecutorOptions{"the executor of statuses"}};  // last: they join before the rest goes
  Executor cancel_executor_{ExecutorOptions{"the executor of cancellations", 1, ExecutorPriority::kUrgent}};
};

}  // namespace external_command
