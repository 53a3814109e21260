// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nodelet/loader.h>
#include <ros/service_server.h>

#include <memory>
#include <string>
#include <vector>

#include "external_command/GetCommandStatus.h"
#include "external_command/ros/command_processor.h"

namespace external_command {

/// Loads the processors of its list as nodelets beside it, and serves the status of every command.
class ExternalCommandProcessComponent : public CommandProcessor {
 public:
  ExternalCommandProcessComponent();
  ~ExternalCommandProcessComponent() override;

 private:
  ros::NodeHandle contextParameters() const override { return getPrivateNodeHandle(); }
  void start() override;
  void open() override;

  void tellWhatIsServed();

  void loadProcessors(const std::vector<std::string>& processors);

  /// Empty where the processor runs, else why it does not.
  std::string load(const std::string& type);

  nodelet::Loader loader_;
  ros::ServiceServer status_server_;
  std::unique_ptr<DedicatedLane> status_lane_;  // last: joins before the rest goes
};

}  // namespace external_command
