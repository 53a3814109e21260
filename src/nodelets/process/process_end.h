// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace external_command {

/// Lets SIGINT and SIGTERM (Ctrl-C, and what systemd and docker send) end this process in order: services that are left
/// behind mislead their callers. To be called after ros::init() with NoSigintHandler.
/// @param shuts_ros_down  false: the process does that itself, when it is ready for it.
void endOnSignal(bool shuts_ros_down);

/// Has one of them come, or was noteEnd() called?
bool mustEnd();
void noteEnd();

/// @return false where the process is to end before the time [s] is over.
bool sleepUnlessEnding(double duration);

/// @return false where the process is to end before a ROS master answers.
bool waitForMaster();

}  // namespace external_command
