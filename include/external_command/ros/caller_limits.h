// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/ros/parameters.h"

namespace external_command {

/// Who may call a service. It keeps mistakes out, not attackers: ROS 1 believes whatever name a node gives.
struct CallerLimits {
  bool is_enabled = true;
  std::vector<std::string> allowed;  ///< full node names; empty: all

  /// @throws InvalidRequest  the service is switched off, or `caller` is none of the allowed.
  void require(const std::string& caller, const std::string& service) const;
};

/// `enabled` and `allowed_callers`, node names relative to the namespace above the reader's.
CallerLimits readCallerLimits(const ParameterReader& reader);

}  // namespace external_command
