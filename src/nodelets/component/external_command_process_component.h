// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nodelet/loader.h>

#include <memory>
#include <string>
#include <vector>

#include "command_services.h"
#include "external_command/ros/command_processor.h"
#include "map_services.h"

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
  std::unique_ptr<CommandServices> command_services_;
  std::unique_ptr<MapServices> map_services_;
};

}  // namespace external_command
