// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/caller_limits.h"

#include <ros/names.h>

#include <algorithm>

#include "external_command/core/error.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"

namespace external_command {

void CallerLimits::require(const std::string& caller, const std::string& service) const {
  if (!is_enabled) throw InvalidRequest(text(service, " is switched off (~enabled)"));
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), caller) != allowed.end()) return;
  std::string names;
  for (const std::string& name : allowed) names += (names.empty() ? "" : ", ") + name;
  throw InvalidRequest(text("the caller ", caller.empty() ? std::string("without a name") : printable(caller),
                            " is not allowed to call ", service, "; ~allowed_callers names ", names));
}

CallerLimits readCallerLimits(const ParameterReader& reader) {
  CallerLimits limits;
  reader.read("enabled", &limits.is_enabled);
  reader.readNames("allowed_callers", &limits.allowed);
  const std::string above = ros::names::parentNamespace(reader.name());
  for (std::string& name : limits.allowed) {
    if (name[0] != '/') name = ros::names::append(above, name);
  }
  return limits;
}

}  // namespace external_command
