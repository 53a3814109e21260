// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/steady_timer.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "external_command/ChassisCommand.h"
#include "external_command/ChassisControl.h"
#include "external_command/ros/service_command_processor.h"
#include "heard_chassis.h"
#include "pending_signals.h"

namespace external_command {

/// Lights, horn, and operations of somebody else's.
class ChassisCommandProcessor : public ServiceCommandProcessor<ChassisControl> {
 public:
  ChassisCommandProcessor();
  ~ChassisCommandProcessor() override;

 private:
  void start() override;
  void subscribe(double timeout);
  void check(const ChassisCommand& command) const override;
  CommandStatus execute(const ChassisCommand& command, const AdmittedCommand& admitted, Response* response) override;
  void onTick();
  void record(const PendingSignals::Changes& changes);

  double max_request_age_ = 2.0;  ///< [s]
  std::vector<ros::Publisher> publishers_;

  std::mutex mutex_;
  std::optional<PendingSignals> pending_;  ///< these guarded by the mutex
  std::optional<HeardChassis> chassis_;
  std::atomic<bool> is_waiting_{false};  ///< there may be something pending

  Executor watch_executor_{
      ExecutorOptions{"the executor of the chassis' signals"}};  // before its users: they leave its queue first
  ros::Subscriber chassis_subscriber_;
  Periodic timer_;
};

}  // namespace external_command
