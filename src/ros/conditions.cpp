// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/conditions.h"

#include <algorithm>
#include <exception>
#include <map>
#include <utility>

namespace external_command {

namespace {

void lookAt(const std::function<std::string()>& check, Condition* condition) {
  try {
    const std::string words = check();
    if (condition->message.empty()) condition->message = words;
  } catch (const std::exception& error) {
    condition->is_met = false;
    condition->message = error.what();
  }
}

}  // namespace

Conditions::Entry::~Entry() {
  if (conditions_ == nullptr) return;
  const std::lock_guard<std::mutex> lock(conditions_->mutex_);
  conditions_->needs_.erase(need_);
}

Conditions::Entry Conditions::add(const std::string& name, const std::string& service, Check check) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {this, needs_.insert(needs_.end(), Need{name, service, std::move(check)})};
}

std::vector<Condition> Conditions::look() const {
  std::map<std::string, Condition> conditions;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Need& need : needs_) {
    Condition& condition = conditions.emplace(need.name, Condition{need.name, true, "", {}}).first->second;
    auto& services = condition.needed_by;
    if (std::find(services.begin(), services.end(), need.service) == services.end()) services.push_back(need.service);
    if (condition.is_met) lookAt(need.check, &condition);  // the first that is missing is told
  }
  std::vector<Condition> found;
  for (auto& [name, condition] : conditions) {
    std::sort(condition.needed_by.begin(), condition.needed_by.end());
    found.push_back(std::move(condition));
  }
  return found;
}

}  // namespace external_command
