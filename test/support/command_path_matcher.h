// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "support/command_path_check.h"

namespace external_command {

/// commandPathFault() as a test says it.
inline testing::AssertionResult isDrivableCommandPath(const Path& path, const VehicleParams& vehicle,
                                                      const std::optional<Pose2d>& start = std::nullopt,
                                                      const CommandPathLimits& limits = {}) {
  const std::string fault = commandPathFault(path, vehicle, start, limits);
  return fault.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << fault;
}

}  // namespace external_command
