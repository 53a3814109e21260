// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "external_command/VehicleSignal.h"
#include "external_command/ros/command_registry.h"
#include "pending_list.h"

namespace external_command {

/// @throws InvalidRequest  a field is none of VehicleSignal's constants; the text names it as `basic_signal.<field>`.
void checkSignals(const VehicleSignal& commanded);

/// True where at least one signal is commanded to change.
bool commandsAny(const VehicleSignal& commanded);

/// The chassis commands whose signals the chassis does not report yet. Each call returns the statuses that changed.
/// Not thread-safe.
class PendingSignals {
 public:
  using Changes = std::vector<StatusChange>;

  /// @param timeout  after which the end of a command is UNKNOWN [s].
  explicit PendingSignals(double timeout) : timeout_(timeout) {}

  /// To be called right before the command is sent. An older one that wants the same signal otherwise is superseded.
  /// @param now  [s], of any steady clock.
  Changes add(const AdmittedCommand& command, const VehicleSignal& commanded, double now);

  Changes onChassis(const VehicleSignal& reported);
  Changes onTime(double now);

  /// What is pending is waited for no longer: the processor is unloaded.
  Changes giveUp() { return endAll(&pending_); }

  bool empty() const { return pending_.empty(); }

  /// Waits no longer for those whose command was ended otherwise: for them `is_running` is false.
  void keepWhere(const std::function<bool(CommandSerial)>& is_running);

 private:
  struct Pending {
    AdmittedCommand command;
    VehicleSignal commanded;
    double deadline = 0.0;  ///< [s]
  };

  const double timeout_;
  std::vector<Pending> pending_;
  VehicleSignal reported_;  ///< by the chassis, at last
};

}  // namespace external_command
