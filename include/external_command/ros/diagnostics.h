// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "external_command/ros/conditions.h"

namespace external_command {

/// Publishes on /diagnostics how the conditions stand, in the same words as readiness and refusals, each with more
/// values where there are some. Not thread-safe.
class Diagnostics {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// @param parameters  of `diagnostic_period` and `diagnostics_use_fqn`; its namespace is the name before the colon.
  /// @param conditions  must live as long as this.
  /// @throws InvalidParameter  `diagnostic_period` is no number in [0.1, 3600] s, or `diagnostics_use_fqn` no boolean.
  Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& parameters, const Conditions& conditions);

  /// Adds values to the condition `name`, or a status of its own where there is none of that name.
  void add(const std::string& name, std::function<void(Status&)> fill);

  /// Between two calls of publish() [s], in [0.1, 3600].
  double period() const { return period_; }

  void publish();

 private:
  void setTasks();
  void fill(const std::string& name, Status& status) const;

  const Conditions& conditions_;
  const double period_;
  diagnostic_updater::Updater updater_;
  std::map<std::string, std::function<void(Status&)>> values_;
  std::map<std::string, Condition> seen_;  ///< by their names
  std::set<std::string> tasks_;
};

}  // namespace external_command
