// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace external_command {

/// The folder that a parameter means: `~` at its front is the home folder; empty is `inside` in the folder of ROS,
/// $ROS_HOME or else ~/.ros.
std::string rosFolder(const std::string& parameter, const std::string& inside);

}  // namespace external_command
