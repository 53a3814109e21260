// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/service_server.h>

#include <memory>

#include "external_command/FindMapObjects.h"
#include "external_command/map/object_search.h"
#include "external_command/ros/process_context.h"

namespace external_command {

/// What the map knows, for programs that have no map of their own. Large searches delay each other, and nothing else.
class MapServices {
 public:
  /// @throws InvalidParameter  @throws InternalError  this process has the service already.
  MapServices(const ros::NodeHandle& nh, const ParameterReader& parameters, std::shared_ptr<ProcessContext> context);
  ~MapServices();

 private:
  FindMapObjects::Response find(const FindMapObjects::Request& request, const MessageSize& size) const;

  const std::shared_ptr<ProcessContext> context_;
  ros::ServiceServer server_;
  Executor executor_{ExecutorOptions{"the executor of the map's objects"}};  // last: it joins before the rest goes
};

/// @throws InvalidRequest  kind is none of MapObject's constants.
ObjectQuery toQuery(const FindMapObjects::Request& request);

MapObject toMsg(const HdMap& map, const FoundObject& object);

}  // namespace external_command
