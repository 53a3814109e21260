// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/Speed.h"
#include "external_command/SpeedCommand.h"
#include "external_command/ros/service_command_processor.h"

namespace external_command {

/// Changes the speed of the running motion command.
class SpeedCommandProcessor : public ServiceCommandProcessor<Speed> {
 public:
  SpeedCommandProcessor();
  ~SpeedCommandProcessor() override;

 private:
  void start() override;
  void check(const SpeedCommand& command) const override;
  CommandStatus execute(const SpeedCommand& command, const AdmittedCommand& admitted, Response* response) override;

  double max_request_age_ = 2.0;  ///< [s]
  std::vector<ros::Publisher> publishers_;
};

}  // namespace external_command
