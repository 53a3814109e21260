// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <string>
#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/bounded_service.h"
#include "external_command/ros/executor.h"

namespace external_command {

/// A service of bounded requests on an executor.
/// @throws InternalError  this process has a service of that name already.
template <class Service>
ros::ServiceServer serveOn(Executor* executor, ros::NodeHandle nh, const std::string& name,
                           BoundedServiceCallbacks<Service> callbacks, const RequestLimits& limits) {
  ros::AdvertiseServiceOptions options = boundedService<Service>(name, std::move(callbacks), limits);
  options.callback_queue = executor->queue();
  ros::ServiceServer server = nh.advertiseService(options);
  if (server) return server;
  throw InternalError(text("service ", nh.resolveName(name), " is advertised by this process already; is the ",
                           "component loaded twice, or has another service the same name in the parameter ..._name ",
                           "that sets it?"));
}

}  // namespace external_command
