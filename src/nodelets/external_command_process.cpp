// SPDX-License-Identifier: Apache-2.0
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <csignal>

/// The component as a node of its own, without a nodelet manager.
int main(int argc, char** argv) {
  ros::init(argc, argv, "external_command");
  nodelet::Loader loader;
  // As for Ctrl-C: systemd and docker send this one, and services that are left behind mislead their callers.
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  const nodelet::M_string remappings(ros::names::getRemappings());
  const nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), "external_command/ExternalCommandProcessComponent", remappings,
                   arguments)) {
    return ros::isShuttingDown() ? 0 : 1;  // the component has told why; to be stopped while starting is no failure
  }
  ros::spin();
  return 0;
}
