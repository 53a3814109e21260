// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/diagnostics.h"

#include <utility>

#include "external_command/ros/parameters.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

/// The updater reads them too, and takes whatever it finds; the second in ROS Noetic only.
double readPeriod(const ros::NodeHandle& parameters) {
  const ParameterReader reader(parameters);
  double period = 1.0;
  bool has_full_names = false;
  reader.readWithin("diagnostic_period", 0.1, 3600.0, &period);
  reader.read("diagnostics_use_fqn", &has_full_names);
  return period;
}

}  // namespace

Diagnostics::Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& parameters, const Conditions& conditions)
    : conditions_(conditions), period_(readPeriod(parameters)), updater_(nh, parameters, parameters.getNamespace()) {
  updater_.setHardwareID("none");
}

void Diagnostics::add(const std::string& name, std::function<void(Status&)> fill) { values_[name] = std::move(fill); }

void Diagnostics::publish() {
  seen_.clear();
  for (Condition& condition : conditions_.look()) {
    const std::string name = condition.name;
    seen_.emplace(name, std::move(condition));
  }
  setTasks();
  updater_.force_update();
}

/// The conditions come and go with the processors.
void Diagnostics::setTasks() {
  std::set<std::string> wanted;
  for (const auto& [name, condition] : seen_) wanted.insert(name);
  for (const auto& [name, values] : values_) wanted.insert(name);
  for (const std::string& name : tasks_) {
    if (wanted.count(name) == 0) updater_.removeByName(name);
  }
  for (const std::string& name : wanted) {
    if (tasks_.count(name) == 0) updater_.add(name, [this, name](Status& status) { fill(name, status); });
  }
  tasks_ = std::move(wanted);
}

void Diagnostics::fill(const std::string& name, Status& status) const {
  const auto condition = seen_.find(name);
  if (condition == seen_.end()) {
    status.summary(Status::OK, "");
  } else {
    status.summary(condition->second.is_met ? Status::OK : Status::ERROR, statusMessage(condition->second.message));
    std::string services;
    for (const std::string& service : condition->second.needed_by) services += (services.empty() ? "" : ", ") + service;
    status.add("needed by", services);
  }
  const auto values = values_.find(name);
  if (values != values_.end()) values->second(status);
}

}  // namespace external_command
